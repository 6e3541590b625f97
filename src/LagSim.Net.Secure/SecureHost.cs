using System;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>
/// Protects a host's sessions: every datagram is encrypted and authenticated, and clients can tell this host from any other.
/// </summary>
/// <remarks>
/// Give it to <see cref="Sessions.HostOptions.Protection"/>. Clients without a protection of their own are refused. Safe on any thread;
/// sessions on different ports may share it. Cost: one agreement for each join that is read, however many former keys there are, two more
/// for each that is answered; docs/SECURITY.md has times.
/// </remarks>
/// <example>
/// <code>
/// HostIdentity identity = HostIdentity.Draw();
/// using PeerThread host = PeerThread.Host(scene, udpPort: 5000, new HostOptions { Protection = new SecureHost(identity) });
/// Console.WriteLine(new HostAddress("192.168.0.7", 5000, identity.Fingerprint)); // all that a client needs
/// </code>
/// </example>
public sealed class SecureHost : IHostProtection
{
    private readonly UsedTokens used;
    private readonly TokenKey? tokens;
    private readonly Func<DateTimeOffset> clock;

    /// <summary>Protects the sessions of a host with this identity.</summary>
    /// <param name="identity">The identity.</param>
    /// <param name="tokens">The key of the backend whose connect tokens clients need; null to let in clients without a token.</param>
    /// <exception cref="ArgumentNullException">The identity is null.</exception>
    public SecureHost(HostIdentity identity, TokenKey? tokens = null)
        : this(identity, tokens, static () => DateTimeOffset.UtcNow)
    {
    }

    // clock is the date, by which tokens are valid; elapsed the time that nobody sets, by which used ones are forgotten.
    internal SecureHost(HostIdentity identity, TokenKey? tokens, Func<DateTimeOffset> clock, Func<TimeSpan>? elapsed = null)
    {
        used = new UsedTokens(elapsed);
        this.tokens = tokens;
        this.clock = clock;
        Identity = identity ?? throw new ArgumentNullException(nameof(identity));
    }

    /// <summary>The host's identity.</summary>
    public HostIdentity Identity { get; }

    /// <inheritdoc/>
    public bool RequiresToken => tokens is not null;

    /// <inheritdoc/>
    public TokenReading ReadToken(ReadOnlySpan<byte> token)
    {
        TokenReading reading = new(TokenFault.OtherIssuer);
        DateTimeOffset now = clock();
        foreach (Curve25519KeyPair keys in tokens is null ? [] : Identity.KeysAt(now))
        {
            reading = ConnectToken.Read(token, HostFingerprint.OfPublicKey(keys.PublicKey), tokens!, now);
            if (reading.Fault != TokenFault.OtherHost)
            {
                break; // also for one that names this host by a former key
            }
        }

        return reading.Fault != TokenFault.None || !ConnectToken.TryReadId(token, out (ulong, ulong) id, out long until) ? reading
            : used.Contains(id) ? new TokenReading(TokenFault.Used)
            : used.SecondsForgotten(until) is long seconds
                ? new TokenReading(TokenFault.Expired, TimeSpan.FromSeconds(Math.Min(seconds, int.MaxValue)))
            : reading;
    }

    /// <inheritdoc/>
    public bool TryUseToken(ReadOnlySpan<byte> token) =>
        ConnectToken.TryReadId(token, out (ulong, ulong) id, out long until) && used.Add(id, until);

    /// <inheritdoc/>
    public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination)
    {
        DateTimeOffset now = clock();
        int key = Identity.KeyOf(HostFingerprint.Read(wanted), now);
        Identity.KeyAt(key, now)!.PublicKey.CopyTo(destination);
        return key;
    }

    /// <inheritdoc/>
    public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload)
    {
        if (Identity.KeyAt(key, clock()) is not Curve25519KeyPair keys)
        {
            return null; // its time is over, since it was shown
        }

        byte[] binding = new byte[IHostProtection.BindingBytes];
        NoiseSymmetricState state = NoiseHandshake.Begin(prologue, keys.PublicKey);
        if (NoiseHandshake.TryReadFirst(state, keys, message, payload, binding))
        {
            return new HostHandshake(state, message.Slice(0, NoiseHandshake.KeyBytes).ToArray(), binding, Identity.Fingerprint);
        }

        state.Dispose();
        return null;
    }

    /// <inheritdoc/>
    public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key)
    {
        byte[] secret = Identity.Keys.PrivateKey.ToArray(), ofAll = new byte[Sha256.Bytes];
        Span<byte> hash = stackalloc byte[Sha256.Bytes];
        Sha256.Hmac(secret, "LagSim reset"u8, default, ofAll);
        Sha256.Hmac(ofAll, link, default, hash);
        hash.Slice(0, IHostProtection.ResetKeyBytes).CopyTo(key);
        CryptographicOperations.ZeroMemory(secret);
        CryptographicOperations.ZeroMemory(ofAll);
        CryptographicOperations.ZeroMemory(hash);
    }
}
