using System;
using BenchmarkDotNet.Attributes;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Bench;

/// <summary>What protection costs: a datagram sealed, opened, refused; a handshake of a join.</summary>
[MemoryDiagnoser]
public class ProtectionBenchmark
{
    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly byte[] datagram = new byte[100];
    private readonly byte[] plain = new byte[100];
    private readonly byte[] sealing = new byte[WireFormat.MaxBytes];
    private readonly byte[] opened = new byte[WireFormat.MaxBytes];
    private readonly byte[] shown = new byte[IHostProtection.IdentityBytes];
    private readonly byte[] prologue = new byte[WireFormat.JoinPrologueBytes];
    private readonly byte[] claims = new byte[WireFormat.JoinClaimBytes];
    private readonly byte[] join = new byte[IHostProtection.HandshakeOverhead + WireFormat.JoinClaimBytes];
    private readonly byte[] welcome = new byte[IHostProtection.WelcomeOverhead + WireFormat.SecureWelcomePayloadBytes];
    private readonly byte[] terms = new byte[WireFormat.SecureWelcomePayloadBytes];
    private readonly UpdateDatagram update = new();
    private SecureHost host = null!;
    private IDatagramCipher cipher = null!;
    private LinkSeal sender = null!;
    private BouncyCastleAead castle = null!;
    private byte[] genuine = null!;
    private byte[] forged = null!;
    private byte[] forgedForCastle = null!;
    private byte[] mutated = null!;
    private ulong number;

    [GlobalSetup]
    public void SetUp()
    {
        host = new SecureHost(identity);
        host.WriteIdentity(new byte[IHostProtection.FingerprintBytes], shown);
        using IClientHandshake client = new SecureClient(identity.Fingerprint).Begin(shown, prologue)!;
        client.Write(claims, join);
        using IHostHandshake read = host.TryRead(0, prologue, join, claims)!;
        cipher = read.Accept("", terms, welcome);
        sender = new LinkSeal(client.TryFinish("", welcome, terms)!);
        castle = new BouncyCastleAead(shown);
        forgedForCastle = new byte[plain.Length + IDatagramCipher.TagBytes];
        castle.Seal(0, default, plain, forgedForCastle);
        forgedForCastle[^1] ^= 1;
        new LeaveDatagram(7, 1, LeaveReason.Left).Encode(datagram);
        genuine = sealing.AsSpan(0, sender.Seal(datagram, sealing)).ToArray();
        forged = [.. genuine];
        forged[^1] ^= 1;
        mutated = new byte[update.EncodedLength];
        update.Encode(mutated);
        mutated[^1] = 1; // an entry that is not there
    }

    [GlobalCleanup]
    public void CleanUp() => identity.Dispose();

    /// <summary>A datagram of 100 bytes, framing included.</summary>
    [Benchmark]
    public int Seal() => sender.Seal(datagram, sealing);

    /// <summary>The cipher alone, by Bouncy Castle, as on Mono and in browsers.</summary>
    [Benchmark]
    public void SealByBouncyCastle() => castle.Seal(++number, default, plain, sealing);

    [Benchmark]
    public bool OpenForgedByBouncyCastle() => castle.TryOpen(0, default, forgedForCastle, opened);

    [Benchmark]
    public bool Open() => SealedDatagram.TryDecode(genuine, out SealedDatagram one, out _) && one.TryOpen(cipher, opened, out _);

    [Benchmark]
    public bool OpenForged() => SealedDatagram.TryDecode(forged, out SealedDatagram one, out _) && one.TryOpen(cipher, opened, out _);

    /// <summary>What a session without protection does with a malformed update, to compare with.</summary>
    [Benchmark(Baseline = true)]
    public bool RefuseMalformed() => update.TryDecode(mutated, out _);

    /// <summary>What a host does for a join of noise, and first for any: an agreement.</summary>
    [Benchmark]
    public void ReadJoin()
    {
        using IHostHandshake? read = host.TryRead(0, prologue, join, claims);
    }

    /// <summary>Both sides of a whole join: seven agreements and keys.</summary>
    [Benchmark]
    public void WholeHandshake()
    {
        using IClientHandshake client = new SecureClient(identity.Fingerprint).Begin(shown, prologue)!;
        client.Write(claims, join);
        using IHostHandshake read = host.TryRead(0, prologue, join, claims)!;
        using IDatagramCipher hostEnd = read.Accept("", terms, welcome);
        using IDatagramCipher clientEnd = client.TryFinish("", welcome, terms)!;
    }
}
