using System;
using System.Collections.Generic;
using System.Text;
using LagSim.Net.Protection;

namespace LagSim.Corpus;

/// <summary>
/// What a protected session's cryptography makes of fixed keys, line by line: the same on every runtime, by whichever library computes it
/// there.
/// </summary>
public static class SecureTranscript
{
    /// <summary>The file of the corpus that holds the lines.</summary>
    public const string FileName = "secure.txt";

    private static readonly byte[] Prologue = Bytes(1, 28);

    /// <summary>Computes the lines: a name, a space, hexadecimal digits.</summary>
    public static IReadOnlyList<string> Lines()
    {
        List<string> lines = new();
        using Curve25519KeyPair host = new(Bytes(3, 32)), client = new(Bytes(5, 32)), answer = new(Bytes(7, 32));
        using HostIdentity identity = HostIdentity.TryParse(Hex(Bytes(3, 32)), out HostIdentity? parsed) ? parsed! : throw new InvalidOperationException();
        lines.Add($"fingerprint {identity.Fingerprint}");
        using NoiseSymmetricState mine = NoiseHandshake.Begin(Prologue, host.PublicKey);
        using NoiseSymmetricState its = NoiseHandshake.Begin(Prologue, host.PublicKey);
        byte[] join = new byte[48 + 45], welcome = new byte[48 + 48], preShared = new byte[PreSharedKey.Bytes], read = new byte[48];
        PreSharedKey.Write("a connect key, ü", preShared);
        Require(NoiseHandshake.TryMixFirst(mine, client, host.PublicKey));
        byte[] binding = new byte[IHostProtection.BindingBytes];
        NoiseHandshake.WriteFirst(mine, client, Bytes(9, 45), join);
        Require(NoiseHandshake.TryReadFirst(its, host, join, read, binding));
        Require(NoiseHandshake.TryWriteSecond(its, answer, client.PublicKey, preShared, Bytes(11, 48), welcome));
        Require(NoiseHandshake.TryReadSecond(mine, client, preShared, welcome, read));
        lines.Add($"join {Hex(join)}");
        lines.Add($"welcome {Hex(welcome)}");
        using NoiseCipher clientEnd = NoiseCipher.OfClient(mine);
        using NoiseCipher hostEnd = NoiseCipher.OfHost(its);
        AddSealed(lines, clientEnd, hostEnd, 1, 17, 65_533);
        AddExchanged(lines, mine);
        byte[] reset = new byte[IHostProtection.ResetKeyBytes];
        new SecureHost(identity).WriteResetKey(Bytes(17, 28), reset);
        lines.Add($"reset {Hex(reset)}");
        using TokenIssuer issuer = TokenIssuer.TryParse(Hex(Bytes(13, 32)), out TokenIssuer? kept) ? kept! : throw new InvalidOperationException();
        byte[] token = ConnectToken.Write(
            new PlayerAdmission("account 4711", "Ada", PlayerRights.Act, 3), identity.Fingerprint, DateTimeOffset.UnixEpoch.AddDays(20_000),
            DateTimeOffset.UnixEpoch.AddDays(20_001), Bytes(15, ConnectToken.IdBytes), issuer.Key, Bytes(13, 32));
        lines.Add($"token {Hex(token)}");
        Require(ConnectToken.Read(token, identity.Fingerprint, issuer.Key, DateTimeOffset.UnixEpoch.AddDays(20_000.5)).Fault == TokenFault.None);
        token[^1] ^= 1;
        Require(ConnectToken.Read(token, identity.Fingerprint, issuer.Key, DateTimeOffset.UnixEpoch.AddDays(20_000.5)).Fault == TokenFault.Damaged);
        return lines;
    }

    /// <summary>What an exchange of fresh keys after a handshake makes of fixed keys of one use.</summary>
    private static void AddExchanged(List<string> lines, NoiseSymmetricState handshake)
    {
        byte[] key = new byte[32], chain = new byte[32], offer = new byte[48], answer = new byte[48], prologue = Bytes(19, 12);
        handshake.Split(key, key, chain);
        using Curve25519KeyPair client = new(Bytes(21, 32)), host = new(Bytes(23, 32));
        using NoiseSymmetricState mine = NoiseExchange.Begin(prologue, chain), its = NoiseExchange.Begin(prologue, chain);
        NoiseExchange.WriteFirst(mine, client, default, offer);
        Require(NoiseExchange.TryReadFirst(its, offer, default));
        Require(NoiseExchange.TryWriteSecond(its, host, client.PublicKey, default, answer));
        Require(NoiseExchange.TryReadSecond(mine, client, answer, default));
        lines.Add($"key-exchange {Hex(offer)} {Hex(answer)}");
        using NoiseCipher clientEnd = NoiseCipher.OfClient(mine), hostEnd = NoiseCipher.OfHost(its);
        AddSealed(lines, clientEnd, hostEnd, 70_000);
    }

    private static void AddSealed(List<string> lines, NoiseCipher clientEnd, NoiseCipher hostEnd, params ulong[] numbers)
    {
        foreach (ulong first in numbers)
        {
            ulong number = first;
            foreach (int length in new[] { 1, 64, 1166 })
            {
                byte[] plain = Bytes(number + (ulong)length, length), up = new byte[length + 16], down = new byte[length + 16];
                clientEnd.Seal(number, default, plain, up);
                hostEnd.Seal(number, default, plain, down);
                lines.Add($"sealed-{number++}-{length} {Hash(up)} {Hash(down)}");
            }
        }
    }

    /// <summary>Bytes that look random and are the same everywhere.</summary>
    private static byte[] Bytes(ulong seed, int count)
    {
        byte[] bytes = new byte[count];
        for (int n = 0; n < count; n++)
        {
            seed = (seed * 6_364_136_223_846_793_005) + 1_442_695_040_888_963_407;
            bytes[n] = (byte)(seed >> 56);
        }

        return bytes;
    }

    private static string Hash(byte[] bytes)
    {
        using System.Security.Cryptography.SHA256 sha = System.Security.Cryptography.SHA256.Create();
        return Hex(sha.ComputeHash(bytes));
    }

    private static string Hex(byte[] bytes)
    {
        StringBuilder text = new(2 * bytes.Length);
        foreach (byte one in bytes)
        {
            text.Append(one.ToString("x2", System.Globalization.CultureInfo.InvariantCulture));
        }

        return text.ToString();
    }

    private static void Require(bool condition)
    {
        if (!condition)
        {
            throw new InvalidOperationException("One side of a handshake does not read what the other wrote.");
        }
    }
}
