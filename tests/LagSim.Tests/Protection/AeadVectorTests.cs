using System;
using System.Collections.Generic;
using LagSim.Net.Protection;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>The primitives against the vectors of their standards, by libsodium and by Bouncy Castle.</summary>
public sealed class AeadVectorTests
{
    public static IEnumerable<TheoryDataRow<string>> Makers => [new("libsodium"), new("Bouncy Castle")];

    /// <summary>RFC 8439, A.5: a nonce whose first 32 bits are 0, as all of ours are.</summary>
    [Theory]
    [MemberData(nameof(Makers))]
    public void Open_OfTheVectorOfTheStandard_GivesItsText(string maker)
    {
        using Aead cipher = Make(maker, Convert.FromHexString("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0"));
        byte[] closed = Convert.FromHexString(
            "64a0861575861af460f062c79be643bd5e805cfd345cf389f108670ac76c8cb24c6cfc18755d43eea09ee94e382d26b0bdb7b73c321b0100d4f03b7f355894cf"
            + "332f830e710b97ce98c8a84abd0b948114ad176e008d33bd60f982b1ff37c8559797a06ef4f0ef61c186324e2b3506383606907b6a7c02b0f9f6157b53c867e4"
            + "b9166c767b804d46a59b5216cde7a4e99040c5a40433225ee282a1b0a06c523eaf4534d7f83fa1155b0047718cbc546a0d072b04b3564eea1b422273f548271a"
            + "0bb2316053fa76991955ebd63159434ecebb4e466dae5a1073a6727627097a1049e617d91d361094fa68f0ff77987130305beaba2eda04df997b714d6c6f2c29"
            + "a6ad5cb4022b02709b" + "eead9d67890cbb22392336fea1851f38");
        byte[] plain = new byte[closed.Length - Aead.TagBytes];
        Assert.True(cipher.TryOpen(0x0807060504030201, Convert.FromHexString("f33388860000000000004e91"), closed, plain));
        Assert.StartsWith("Internet-Drafts are draft documents valid", System.Text.Encoding.UTF8.GetString(plain), StringComparison.Ordinal);
        byte[] again = new byte[closed.Length];
        using Aead sealing = Make(maker, Convert.FromHexString("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0"));
        sealing.Seal(0x0807060504030201, Convert.FromHexString("f33388860000000000004e91"), plain, again);
        Assert.Equal(closed, again);
    }

    [Theory]
    [MemberData(nameof(Makers))]
    public void Open_WithOneBitChangedAnywhere_IsRefused(string maker)
    {
        Random random = new(5);
        byte[] key = new byte[32];
        random.NextBytes(key);
        using Aead cipher = Make(maker, key);
        for (int n = 0; n < 300; n++)
        {
            byte[] plain = new byte[random.Next(0, 1178)], opened = new byte[plain.Length];
            random.NextBytes(plain);
            byte[] closed = new byte[plain.Length + Aead.TagBytes], ad = new byte[random.Next(0, 40)];
            ulong number = (ulong)random.NextInt64();
            cipher.Seal(number, ad, plain, closed);
            Assert.True(cipher.TryOpen(number, ad, closed, opened));
            Assert.Equal(plain, opened);
            Assert.False(cipher.TryOpen(number ^ (1UL << random.Next(64)), ad, closed, opened));
            closed[random.Next(closed.Length)] ^= (byte)(1 << random.Next(8));
            Assert.False(cipher.TryOpen(number, ad, closed, opened));
        }

        Assert.False(cipher.TryOpen(1, [], new byte[Aead.TagBytes - 1], []));
    }

    [Fact]
    public void Seal_ByLibsodiumAndByBouncyCastle_GivesTheSameBytes()
    {
        Random random = new(6);
        for (int n = 0; n < 100; n++)
        {
            byte[] key = new byte[32], plain = new byte[random.Next(0, 1178)], ad = new byte[random.Next(0, 40)];
            random.NextBytes(key);
            random.NextBytes(plain);
            using Aead sodium = Make("libsodium", key), castle = Make("Bouncy Castle", key);
            byte[] one = new byte[plain.Length + Aead.TagBytes], other = new byte[plain.Length + Aead.TagBytes];
            sodium.Seal((ulong)n, ad, plain, one);
            castle.Seal((ulong)n, ad, plain, other);
            Assert.Equal(one, other);
        }
    }

    /// <summary>RFC 7748, 6.1.</summary>
    [Fact]
    public void Agreement_OfTheVectorOfTheStandard_GivesItsSecret()
    {
        using Curve25519KeyPair alice = new(Convert.FromHexString("77076d0a7318a57d3c16c17251b26645df4c2f87ebc0992ab177fba51db92c2a"));
        using Curve25519KeyPair bob = new(Convert.FromHexString("5dab087e624a8a4b79e17f8b83800ee66f3bb1292618b6fd1c2f8b27ff88e0eb"));
        Assert.Equal("8520f0098930a754748b7ddcb43ef75a0dbf3a0d26381af4eba4a98eaa9b4e6a", Convert.ToHexStringLower(alice.PublicKey));
        Assert.Equal("de9edb7d7b7dc1b4d35b61c2ece435373f8343c85b78674dadfc7e146f882b4f", Convert.ToHexStringLower(bob.PublicKey));
        byte[] mine = new byte[32], its = new byte[32];
        Assert.True(alice.TryAgree(bob.PublicKey, mine) && bob.TryAgree(alice.PublicKey, its));
        Assert.Equal("4a5d9d5ba4ce2de1728e3bf480350f25e07e21c947d19e3376f09b3c1e161742", Convert.ToHexStringLower(mine));
        Assert.Equal(mine, its);
    }

    private static Aead Make(string maker, byte[] key) => maker == "libsodium" ? new SodiumAead(key) : new BouncyCastleAead(key);
}
