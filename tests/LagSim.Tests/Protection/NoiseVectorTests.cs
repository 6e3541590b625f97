using System;
using LagSim.Net.Protection;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// The handshake and the exchange of fresh keys against published vectors: Noise_NKpsk2_25519_ChaChaPoly_SHA256 and
/// Noise_NNpsk0_25519_ChaChaPoly_SHA256 of cacophony's vectors.
/// </summary>
public sealed class NoiseVectorTests
{
    private static readonly byte[] Prologue = Hex("4a6f686e2047616c74");
    private static readonly byte[] PreShared = Hex("54686973206973206d7920417573747269616e20706572737065637469766521");
    private static readonly byte[] HostPublic = Hex("31e0303fd6418d2f8c0e78b91f22e8caed0fbe48656dcf4767e4834f701b8f62");

    private static readonly (string Payload, string Sealed)[] Messages =
    [
        ("4c756477696720766f6e204d69736573", "ca35def5ae56cec33dc2036731ab14896bc4c75dbb07a61f879f8e3afa4c7944acda3057fb216b0fb4c6d571e776b426612636e99cf4ac1de41442fb2128ca29"),
        ("4d757272617920526f746862617264", "95ebc60d2b1fa672c1f46a8aa265ef51bfe38e7ccb39ec5be34069f14480884330fcb4ab2b68a6f612414145258aa079533be57174ec7ae7c76845312a3f07"),
        ("462e20412e20486179656b", "129789ee959ffef891a580c6fc073cf91d706e26602cc096c35d84"),
        ("4361726c204d656e676572", "36b35298bc84e0a24644e309563b2d6c3f9a31dc142b122e0266db"),
        ("4a65616e2d426170746973746520536179", "4b080dfd53e42e3f45d96f75f15fdbcce95a75fb83c51ee366281528204c1bf0b4"),
        ("457567656e2042f6686d20766f6e2042617765726b", "0bce31a0c1c37626c3e4a0000afa7e4e06636e1bbc44fc1a24e18e373f07c8ad6e3a03b877"),
    ];

    [Fact]
    public void Handshake_OfThePublishedVector_GivesItsBytes()
    {
        using Curve25519KeyPair host = new(Hex("4a3acbfdb163dec651dfa3194dece676d437029c62a408b4c5ea9114246e4893"));
        using Curve25519KeyPair client = new(Hex("893e28b9dc6ca8d611ab664754b8ceb7bac5117349a4439a6b0569da977c464a"));
        using Curve25519KeyPair answer = new(Hex("bbdb4cdbd309f1a1f2e1456967fe288cadd6f712d65dc7b7793d5e63da6b375b"));
        Assert.Equal(HostPublic, host.PublicKey.ToArray());
        using NoiseSymmetricState mine = NoiseHandshake.Begin(Prologue, HostPublic);
        using NoiseSymmetricState its = NoiseHandshake.Begin(Prologue, host.PublicKey);

        byte[] first = new byte[Messages[0].Sealed.Length / 2];
        Assert.True(NoiseHandshake.TryMixFirst(mine, client, HostPublic));
        byte[] binding = mine.HandshakeHash.ToArray(), itsBinding = new byte[32];
        NoiseHandshake.WriteFirst(mine, client, Hex(Messages[0].Payload), first);
        Assert.Equal(Messages[0].Sealed, Text(first));
        byte[] said = new byte[Messages[0].Payload.Length / 2];
        Assert.True(NoiseHandshake.TryReadFirst(its, host, first, said, itsBinding));
        Assert.Equal(binding, itsBinding);
        Assert.Equal(Messages[0].Payload, Text(said));

        byte[] second = new byte[Messages[1].Sealed.Length / 2];
        Assert.True(NoiseHandshake.TryWriteSecond(its, answer, client.PublicKey, PreShared, Hex(Messages[1].Payload), second));
        Assert.Equal(Messages[1].Sealed, Text(second));
        said = new byte[Messages[1].Payload.Length / 2];
        Assert.True(NoiseHandshake.TryReadSecond(mine, client, PreShared, second, said));
        Assert.Equal(Messages[1].Payload, Text(said));

        const string hash = "5a0c1a79a0b863fe5d000e829b7e4ffc76200e5c08082d4494968e3f47d0ff61";
        Assert.Equal((hash, hash), (Text(mine.HandshakeHash), Text(its.HandshakeHash)));
        using NoiseCipher clientEnd = NoiseCipher.OfClient(mine);
        using NoiseCipher hostEnd = NoiseCipher.OfHost(its);
        for (int n = 2; n < Messages.Length; n++)
        {
            (NoiseCipher from, NoiseCipher to) = n % 2 == 0 ? (clientEnd, hostEnd) : (hostEnd, clientEnd);
            byte[] plain = Hex(Messages[n].Payload);
            byte[] closed = new byte[plain.Length + IDatagramCipher.TagBytes];
            from.Seal((ulong)(n / 2) - 1, default, plain, closed);
            Assert.Equal(Messages[n].Sealed, Text(closed));
            byte[] opened = new byte[plain.Length];
            Assert.True(to.TryOpen((ulong)(n / 2) - 1, default, closed, opened));
            Assert.Equal(plain, opened);
            Assert.False(from.TryOpen((ulong)(n / 2) - 1, default, closed, opened)); // reflected
        }
    }

    [Fact]
    public void Exchange_OfThePublishedVector_GivesItsBytes()
    {
        const string offered = "ca35def5ae56cec33dc2036731ab14896bc4c75dbb07a61f879f8e3afa4c794479b962b8aff8485742ac32f905ba45369e2465fb59e138a93d67a0d1266b6a54";
        const string answered = "95ebc60d2b1fa672c1f46a8aa265ef51bfe38e7ccb39ec5be34069f144808843d6062704d5a9c422a8e834423f8c1feada7e8d0d910a1a2cd030fb584221e3";
        string[] sealedOnes =
        [
            "e632c3763d7669067383433197a3baddf146e9e70ad4b4e9e59e0f", "64c6bee32ea91c8474bb4c21d7a700109ad45af77b29764ba5eb1e",
            "e2fa0bed0603b62d3ccac2ecabbf3fe33f3e86514909b323361626266cb2471cc8", "0c01dc9cec1fe4ddd692e8dd32188aa351088dc91183639a53b57aa4692b5ebdef8b8ca111",
        ];
        using Curve25519KeyPair client = new(Hex("893e28b9dc6ca8d611ab664754b8ceb7bac5117349a4439a6b0569da977c464a"));
        using Curve25519KeyPair host = new(Hex("bbdb4cdbd309f1a1f2e1456967fe288cadd6f712d65dc7b7793d5e63da6b375b"));
        using NoiseSymmetricState mine = NoiseExchange.Begin(Prologue, PreShared), its = NoiseExchange.Begin(Prologue, PreShared);
        byte[] offer = new byte[offered.Length / 2], answer = new byte[answered.Length / 2], said = new byte[16];
        NoiseExchange.WriteFirst(mine, client, Hex(Messages[0].Payload), offer);
        Assert.Equal(offered, Text(offer));
        Assert.True(NoiseExchange.TryReadFirst(its, offer, said));
        Assert.Equal(Messages[0].Payload, Text(said));
        Assert.True(NoiseExchange.TryWriteSecond(its, host, client.PublicKey, Hex(Messages[1].Payload), answer));
        Assert.Equal(answered, Text(answer));
        Assert.True(NoiseExchange.TryReadSecond(mine, client, answer, said.AsSpan(0, 15)));
        const string hash = "f4d03dc34495c95729ea6de9e1b59004b59733102488b3e24bc441e0be208eaf";
        Assert.Equal((hash, hash), (Text(mine.HandshakeHash), Text(its.HandshakeHash)));
        using NoiseCipher clientEnd = NoiseCipher.OfClient(mine), hostEnd = NoiseCipher.OfHost(its);
        for (int n = 0; n < sealedOnes.Length; n++)
        {
            byte[] plain = Hex(Messages[n + 2].Payload), closed = new byte[plain.Length + IDatagramCipher.TagBytes];
            (n % 2 == 0 ? clientEnd : hostEnd).Seal((ulong)(n / 2), default, plain, closed);
            Assert.Equal(sealedOnes[n], Text(closed));
        }
    }

    /// <summary>What each side must have in common with the other: a bit of any of it changed, and nothing is read.</summary>
    [Theory]
    [InlineData("prologue")]
    [InlineData("pre-shared key")]
    [InlineData("host's key")]
    [InlineData("first message")]
    [InlineData("second message")]
    [InlineData("nothing")]
    public void Handshake_WithOneBitChanged_IsNotRead(string what)
    {
        using Curve25519KeyPair host = Curve25519KeyPair.Draw(), client = Curve25519KeyPair.Draw(), answer = Curve25519KeyPair.Draw();
        byte[] hostKey = host.PublicKey.ToArray(), prologue = [.. Prologue], key = [.. PreShared];
        using NoiseSymmetricState its = NoiseHandshake.Begin(Prologue, host.PublicKey);
        Flip(prologue, what == "prologue");
        Flip(hostKey, what == "host's key");
        using NoiseSymmetricState mine = NoiseHandshake.Begin(prologue, hostKey);
        byte[] first = new byte[32 + 5 + 16], second = new byte[32 + 7 + 16], said = new byte[7];
        Assert.True(NoiseHandshake.TryMixFirst(mine, client, hostKey));
        NoiseHandshake.WriteFirst(mine, client, [1, 2, 3, 4, 5], first);
        Flip(first, what == "first message");
        bool isRead = NoiseHandshake.TryReadFirst(its, host, first, said.AsSpan(0, 5), new byte[32])
            && NoiseHandshake.TryWriteSecond(its, answer, first.AsSpan(0, 32), PreShared, [1, 2, 3, 4, 5, 6, 7], second);
        Flip(key, what == "pre-shared key");
        Flip(second, what == "second message");
        Assert.Equal(what == "nothing", isRead && NoiseHandshake.TryReadSecond(mine, client, key, second, said));
    }

    /// <summary>A public key of small order gives everybody the same secret.</summary>
    [Theory]
    [InlineData("0000000000000000000000000000000000000000000000000000000000000000")]
    [InlineData("0100000000000000000000000000000000000000000000000000000000000000")]
    [InlineData("ecffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff7f")]
    public void Agreement_WithAKeyOfSmallOrder_IsRefused(string key)
    {
        using Curve25519KeyPair host = Curve25519KeyPair.Draw();
        Assert.False(host.TryAgree(Hex(key), new byte[32]));
        byte[] message = new byte[32 + 16];
        Hex(key).CopyTo(message, 0);
        using NoiseSymmetricState state = NoiseHandshake.Begin(Prologue, host.PublicKey);
        Assert.False(NoiseHandshake.TryReadFirst(state, host, message, [], new byte[32]));
        using HostIdentity identity = HostIdentity.Draw();
        Assert.Null(SecureClient.TrustOnFirstUse().Begin(Hex(key), Prologue));
    }

    private static byte[] Hex(string text) => Convert.FromHexString(text);

    private static string Text(ReadOnlySpan<byte> bytes) => Convert.ToHexStringLower(bytes);

    private static void Flip(byte[] bytes, bool isToBe) => bytes[^1] ^= isToBe ? (byte)1 : (byte)0;
}
