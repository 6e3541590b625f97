using System.Linq;
using LagSim.Play;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>What a person at a page may be called: nothing is cut, so what is too long is refused with a sentence.</summary>
public sealed class JoinedNameTests
{
    [Theory]
    [InlineData("", 1)]
    [InlineData("W", 24)]
    [InlineData("\u0416", 24)] // two bytes each
    [InlineData("\u6F22", 21)] // three bytes each: 63
    [InlineData("e\u0301", 21)] // one character of two parts
    public void Name_ThatHasRoom_IsTaken(string character, int count) =>
        Assert.Null(JoinedName.WhyNot(string.Concat(Enumerable.Repeat(character, count))));

    [Theory]
    [InlineData("W", 25, "A name has at most 24 characters; this one has 25.")]
    [InlineData("\u6F22", 22, "66 bytes of UTF-8; at most 64 are allowed.")]
    [InlineData("\u0007", 1, "control character U+0007")]
    public void Name_ThatCannotBe_IsRefusedWithTheReason(string character, int count, string why) =>
        Assert.Contains(why, JoinedName.WhyNot(string.Concat(Enumerable.Repeat(character, count))));
}
