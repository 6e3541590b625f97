using System;
using System.Collections.Generic;
using System.Linq;
using System.Security.Cryptography;
using System.Text;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Tests.Wire;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// Every use of a secret has a label of its own in docs/SECURITY.md, and those that another implementation must compute have that label: what
/// the code makes is computed here from the page's table. (Cookies and session ids only their host computes.) And what stands before a sealed datagram is authenticated with it.
/// </summary>
public sealed class LabelTests
{
    private static readonly byte[] Nonce = BitConverter.GetBytes(0x0102030405060708UL);
    private static readonly byte[] Cookie = [.. Enumerable.Range(20, 16).Select(n => (byte)n)];
    private static readonly byte[] Hash = [.. Enumerable.Range(50, 32).Select(n => (byte)n)];

    [Fact]
    public void Table_OfThePage_IsWhatTheCodeDoes()
    {
        Dictionary<(string Secret, string Use), byte[]> labels = Labels(LayoutPage.Read("SECURITY.md"));
        byte[] key = Encoding.UTF8.GetBytes("kéy"), pass = [.. Cookie.Reverse()], made = new byte[32];
        ulong nonce = BitConverter.ToUInt64(Nonce);

        PreSharedKey.Write("kéy", made);
        Assert.Equal(HMACSHA256.HashData(key, labels[("connect key", "pre-shared key")]), made);
        AssertIs(
            HMACSHA256.HashData(key, (byte[])[.. labels[("connect key", "proof")], .. Nonce, .. Cookie, .. Hash]),
            JoinCookies.Prove("kéy", nonce, new Token128(Cookie), Hash));
        AssertIs(
            HMACSHA256.HashData(pass, (byte[])[.. labels[("pass", "proof")], .. Nonce, .. Cookie, .. Hash]),
            JoinCookies.Prove(new Token128(pass), nonce, new Token128(Cookie), Hash));
        AssertIs(
            HMACSHA256.HashData(pass, (byte[])[.. labels[("reset key", "proof")], (byte)LeaveReason.TimedOut]),
            ResetDatagram.Prove(new Token128(pass), LeaveReason.TimedOut));
        byte[] resets = labels.Single(l => l.Key.Secret == "host's private key").Value, link = [1, 2, 3];
        Assert.True(HostIdentity.TryParse(Convert.ToHexStringLower(Hash), out HostIdentity? identity));
        new SecureHost(identity!).WriteResetKey(link, made);
        Assert.Equal(HMACSHA256.HashData(HMACSHA256.HashData(Hash, resets), link)[..16], made[..16]);
        Assert.Equal(labels.Count, labels.Values.Select(Convert.ToHexString).Distinct().Count());
        Assert.Equal(7, labels.Count);
        identity!.Dispose();
    }

    /// <summary>With the label or the hash left out, or those of another use, it is another proof: the comparison above can fail.</summary>
    [Fact]
    public void Proof_WithoutItsLabelOrForAnotherUse_IsAnother()
    {
        Token128 cookie = new(Cookie), pass = new(Cookie);
        string asKey = Encoding.UTF8.GetString(Cookie); // a connect key whose bytes are those of a pass
        Assert.NotEqual(JoinCookies.Prove(asKey, 1, cookie, Hash), JoinCookies.Prove(pass, 1, cookie, Hash));
        Assert.NotEqual(JoinCookies.Prove("key", 1, cookie, Hash), JoinCookies.Prove("key", 1, cookie));
        Assert.NotEqual(
            new Token128(HMACSHA256.HashData("key"u8, [.. BitConverter.GetBytes(1UL), .. Cookie, .. Hash])), JoinCookies.Prove("key", 1, cookie, Hash));
    }

    /// <summary>
    /// One bit of what stands before the encrypted bytes is changed: it is not opened. The control: sealed without associated data, a changed
    /// session id is taken.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Open_WithAnythingBeforeItChanged_OnlyWithoutAssociatedData(bool isAssociated)
    {
        using NoiseSymmetricState state = NoiseHandshake.Begin([], new byte[32]);
        using NoiseCipher real = NoiseCipher.OfClient(state), itsReal = NoiseCipher.OfHost(state);
        IDatagramCipher client = isAssociated ? real : new WithoutAssociated(real), host = isAssociated ? itsReal : new WithoutAssociated(itsReal);
        byte[] datagram = new byte[WireFormat.LeaveBytes], made = new byte[WireFormat.MaxBytes], opened = new byte[WireFormat.MaxBytes];
        new LeaveDatagram(7, 1, LeaveReason.Left).Encode(datagram);
        byte[] genuine = made[..SealedDatagram.Encode(datagram, 5, client, made)];
        Assert.True(SealedDatagram.TryDecode(genuine, out SealedDatagram one, out _) && one.TryOpen(host, opened, out _));
        int taken = 0;
        for (int bit = 0; bit < 8 * SealedDatagram.PrologueBytes; bit++)
        {
            byte[] changed = [.. genuine];
            changed[bit / 8] ^= (byte)(1 << (bit % 8));
            taken += SealedDatagram.TryDecode(changed, out SealedDatagram other, out _) && other.TryOpen(host, opened, out _) ? 1 : 0;
        }

        Assert.Equal(isAssociated ? 0 : 72, taken); // every bit of session id and generation; header and number are refused in any case
    }

    private static void AssertIs(byte[] hash, Token128 token) => Assert.Equal(new Token128(hash), token);

    private static Dictionary<(string Secret, string Use), byte[]> Labels(string[] page) => page
        .SkipWhile(line => line != "### Labels").SkipWhile(line => !line.StartsWith("|---", StringComparison.Ordinal)).Skip(1)
        .TakeWhile(line => line.StartsWith('|')).Select(line => line.Split('|'))
        .ToDictionary(cells => (cells[1].Trim(), cells[2].Trim()), cells => Encoding.ASCII.GetBytes(cells[3].Trim().Trim('`')));

    private sealed class WithoutAssociated(IDatagramCipher real) : IDatagramCipher
    {
        public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) =>
            real.Seal(number, default, plain, destination);

        public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) =>
            real.TryOpen(number, default, source, plain);

        public IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message) => real.BeginExchange(prologue, message);

        public IDatagramCipher? TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer) =>
            real.TryAnswerExchange(prologue, message, answer);

        public void Dispose() => real.Dispose();
    }
}
