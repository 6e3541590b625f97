using System;
using System.Globalization;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A pass as text: what was written is read, and nothing else is.</summary>
public sealed class PlayerPassTests
{
    private const string Good = "7-00112233445566778899aabbccddeeff";

    [Fact]
    public void ToString_OfAnyPass_IsReadAsTheSame()
    {
        Random random = new(1);
        for (int n = 0; n < 1000; n++)
        {
            Token128 secret = new((ulong)random.NextInt64() << 1, (ulong)random.NextInt64() >> random.Next(64));
            PlayerPass pass = new((byte)random.Next(1, 256), secret);
            Assert.True(PlayerPass.TryParse($" {pass}\n", out PlayerPass again));
            Assert.True(pass == again && pass.Equals((object)again) && pass.GetHashCode() == again.GetHashCode());
            Assert.True(PlayerPass.TryParse(pass.ToString().ToUpperInvariant(), out again) && again == pass);
        }

        Assert.True(PlayerPass.TryParse(Good, out PlayerPass good));
        Assert.Equal((7, Good), (good.Number, good.ToString()));
        Assert.Equal("", default(PlayerPass).ToString());
    }

    [Theory]
    [InlineData(null)]
    [InlineData("")]
    [InlineData("7")]
    [InlineData("7-")]
    [InlineData("-00112233445566778899aabbccddeeff")]
    [InlineData("0-00112233445566778899aabbccddeeff")]
    [InlineData("256-00112233445566778899aabbccddeeff")]
    [InlineData("-7-00112233445566778899aabbccddeeff")]
    [InlineData("+7-00112233445566778899aabbccddeeff")]
    [InlineData("7-00112233445566778899aabbccddeef")]
    [InlineData("7-00112233445566778899aabbccddeeff0")]
    [InlineData("7-00112233445566778899aabbccddeefg")]
    [InlineData("7-0x112233445566778899aabbccddeeff")]
    [InlineData("7- 0112233445566778 99aabbccddeeff")]
    [InlineData("7-00112233445566778899aabbccddeeff-1")]
    [InlineData("7 00112233445566778899aabbccddeeff")]
    public void TryParse_AnythingElse_IsRefused(string? text)
    {
        Assert.False(PlayerPass.TryParse(text, out PlayerPass pass));
        Assert.Equal(default, pass);
    }

    [Fact]
    public void TryParse_MutatedText_NeverThrowsAndReadsOnlyWhatItWouldWrite()
    {
        Random random = new(2);
        const string letters = "0123456789abcdefABCDEF-+ xgЖ٣\0\n";
        for (int n = 0; n < 20_000; n++)
        {
            char[] text = Good.ToCharArray();
            for (int changes = random.Next(1, 4); changes > 0; changes--)
            {
                text[random.Next(text.Length)] = letters[random.Next(letters.Length)];
            }

            string mutated = new(text);
            if (PlayerPass.TryParse(mutated, out PlayerPass pass))
            {
                Assert.Equal(mutated.Trim().ToLower(CultureInfo.InvariantCulture), pass.ToString());
            }
        }
    }
}
