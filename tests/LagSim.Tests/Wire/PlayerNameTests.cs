using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Play;
using LagSim.Tests.Cli;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Wire;

/// <summary>What a peer may call itself: the same rule at the one that joins, at the host, in tokens, at the page and in the tool.</summary>
public sealed class PlayerNameTests
{
    private const string Unseen = "which nobody sees";
    private const string Alone = "by itself, which reads as a player's number";

    /// <summary>The page on the wire has the ranges, so that another implementation need not guess.</summary>
    [Fact]
    public void Ranges_OfThePage_AreThoseOfTheCode()
    {
        (string Kind, int[] Ranges)[] all =
        [
            ("unseen", PlayerName.Unseen), ("selectors", PlayerName.Selectors), ("accents", PlayerName.Accents), ("digits", PlayerName.Digits),
            ("parting", PlayerName.Parting), ("joining", PlayerName.Joining),
        ];
        string[] page = LayoutPage.Read("WIRE.md");
        foreach ((string kind, int[] ranges) in all)
        {
            IEnumerable<string> written = Enumerable.Range(0, ranges.Length / 2)
                .Select(n => ranges[2 * n] == ranges[(2 * n) + 1] ? $"{ranges[2 * n]:X4}" : $"{ranges[2 * n]:X4}-{ranges[(2 * n) + 1]:X4}");
            Assert.Contains($"| {kind} | {string.Join(", ", written)} |", page);
        }
    }

    public static TheoryData<string, string> NoNames => new()
    {
        { "Ann\u202Enna", $"it holds U+202E, {Unseen}" },
        { "Ann\u2066", $"it holds U+2066, {Unseen}" },
        { "\u200FAnn", $"it holds U+200F, {Unseen}" },
        { "\u061C", $"it holds U+061C, {Unseen}" },
        { "A\u200Bnn", $"it holds U+200B, {Unseen}" },
        { "Ann\u2028here: 0 player Bob", $"it holds U+2028, {Unseen}" },
        { "Ann\u00A0Lee", $"it holds U+00A0, {Unseen}" },
        { "\u3164", $"it holds U+3164, {Unseen}" }, // a filler, which is a letter to Unicode
        { "Ann\U000E0041", $"it holds U+E0041, {Unseen}" },
        { "\uFE0F", $"it holds U+FE0F, {Unseen}" },
        { "a \uFE0F", $"it holds U+FE0F, {Unseen}" },
        { "\u0085", "it holds the control character U+0085" },
        { " ", "it is blanks alone" },
        { "    ", "it is blanks alone" },
        { "2", $"it holds the number '2' {Alone}" },
        { "Player 1", $"it holds the number '1' {Alone}" },
        { "Ann, 2 player Bob", $"it holds the number '2' {Alone}" },
        { "Ann,17 spectator Sue", $"it holds the number '17' {Alone}" },
        { "Al at 192.0.2.7; bot 2 B", $"it holds the number '192' {Alone}" },
        { "#2", $"it holds the number '2' {Alone}" },
        { "Ann \uFF12 player", $"it holds the number '\uFF12' {Alone}" },
        { "\u0662", $"it holds the number '\u0662' {Alone}" },
        { "\u2461", $"it holds the number '\u2461' {Alone}" },
        { "\U0001D7D0 player", $"it holds the number '\U0001D7D0' {Alone}" },
        { "2\uFE0F\u20E3", $"it holds the number '2\uFE0F' {Alone}" }, // a key with a 2
        { "2\u0301", $"it holds the number '2\u0301' {Alone}" },
        { "a \u03012", $"it holds the number '2' {Alone}" },
        { "Ann\uFF0C2\uFF1B", $"it holds the number '2' {Alone}" },
        { "2-", $"it holds the number '2' {Alone}" },
        { "-2", $"it holds the number '2' {Alone}" },
        { "2_", $"it holds the number '2' {Alone}" },
        { "_2_", $"it holds the number '2' {Alone}" },
        { "2-3", $"it holds the number '2' {Alone}" },
        { "Ann -17_ player", $"it holds the number '17' {Alone}" },
        { "2\u30FB", $"it holds the number '2' {Alone}" }, // a middle dot
        { " Ann", "it begins or ends with a blank" },
        { "Ann ", "it begins or ends with a blank" },
        { "Ann  Lee", "it begins or ends with a blank, or has two in a row" },
        { "Ann\uFFFD", "it holds U+FFFD, which stands in place of bytes" },
    };

    [Theory]
    [InlineData("")]
    [InlineData("Ann")]
    [InlineData("Ann Lee")]
    [InlineData("Ann2")]
    [InlineData("Ann-2")]
    [InlineData("2_Ann")]
    [InlineData("2nd Ann")]
    [InlineData("R2D2")]
    [InlineData("C3-PO & Zoë (the 3rd)")]
    [InlineData("O'Neill")]
    [InlineData("日本の人")]
    [InlineData("日本2")]
    [InlineData("葛\U000E0100")] // a form of a character of a name
    [InlineData("علي")]
    [InlineData("🎱❤\uFE0F")]
    [InlineData("e\u03012")]
    public void Name_ThatShowsAllThatIsInIt_MayBe(string name)
    {
        Assert.Null(SessionOptions.WhyNoName(name));
        Assert.Null(JoinedName.WhyNot(name));
        Assert.True(Decodes(name));
        new HostOptions { Name = name }.Check();
        Assert.Equal(name, new PlayerAdmission("id", name).Name);
    }

    [Theory]
    [MemberData(nameof(NoNames))]
    public void Name_ThatHidesOrMimicsSomething_IsRefusedEverywhere(string name, string why)
    {
        Assert.StartsWith(why, SessionOptions.WhyNoName(name), StringComparison.Ordinal);
        Assert.Contains(why, JoinedName.WhyNot(name), StringComparison.Ordinal);
        Assert.Contains(why, Assert.Throws<ArgumentException>(new ClientOptions { Name = name }.Check).Message, StringComparison.Ordinal);
        Assert.Contains(why, Assert.Throws<ArgumentException>(new HostOptions { Name = name }.Check).Message, StringComparison.Ordinal);
        Assert.Contains(why, Assert.Throws<ArgumentException>(() => new PlayerAdmission("id", name)).Message, StringComparison.Ordinal);
        Assert.False(Decodes(name));
        Tool.Refuses(2, ["join", "127.0.0.1:9", "--name", name], "--name is not one to show: it ");
    }

    [Fact]
    public void Tool_IssuingATokenForSuchAName_Refuses()
    {
        using TemporaryFolder folder = new();
        string host = $"lagsim://127.0.0.1:5000#0a1b2c3d4e5f60718293a4b5c6d7e8f9";
        string[] call = ["token", "--secret", folder["secret"], "--host", host, "--player", "2"]; // an identity may be a number
        Tool.Refuses(2, [.. call, "--name", "2"], $"The player's name is not one to show: it holds the number '2' {Alone}");
        Assert.Contains("token ", Tool.Run([.. call, "--name", "Ann2"]).Done().Output, StringComparison.Ordinal);
    }

    /// <summary>The ranges are held against what this runtime knows of Unicode: all of four categories, and every digit of a decimal system.</summary>
    [Fact]
    public void Characters_OfUnicode_AreSortedAsTheirCategoriesSay()
    {
        List<string> wrong = [];
        int seen = 0;
        for (int one = 0; one <= 0x10FFFF; one++)
        {
            if (one is >= 0xD800 and < 0xE000)
            {
                continue;
            }

            string text = char.ConvertFromUtf32(one);
            UnicodeCategory category = CharUnicodeInfo.GetUnicodeCategory(one);
            bool hides = category is UnicodeCategory.Control or UnicodeCategory.Format or UnicodeCategory.LineSeparator
                or UnicodeCategory.ParagraphSeparator || (category == UnicodeCategory.SpaceSeparator && one != ' ');
            bool isDigit = category == UnicodeCategory.DecimalDigitNumber;
            bool shows = category is UnicodeCategory.UppercaseLetter or UnicodeCategory.LowercaseLetter or UnicodeCategory.CurrencySymbol
                or UnicodeCategory.MathSymbol or UnicodeCategory.OtherPunctuation;
            string? joined = PlayerName.WhyNone($"a{text}");
            bool isRight = !(hides && joined is null) && !(shows && joined is not null) && !(isDigit && (joined is not null || PlayerName.WhyNone(text) is null));
            bool joins = category is >= UnicodeCategory.ConnectorPunctuation and <= UnicodeCategory.OtherSymbol && joined is null;
            isRight &= !joins || (PlayerName.WhyNone($"2{text}") is not null && PlayerName.WhyNone($"{text}2") is not null);
            seen += hides || isDigit || shows ? 1 : 0;
            if (!isRight)
            {
                wrong.Add($"U+{one:X4} {category}: {joined}");
            }
        }

        Assert.True(wrong.Count == 0, string.Join('\n', wrong.Take(400)));
        Assert.InRange(seen, 5_000, int.MaxValue); // the control: categories are known here
    }

    private static bool Decodes(string name)
    {
        byte[] join = AnyDatagram.Bytes(new JoinDatagram(1, default, default, 2, 3, name: name).Encode);
        RosterDatagram roster = new() { SessionId = 1, UpTo = 1, Newest = 1 };
        roster.TryAdd(new RosterEntry(1, 1, 1, SimTime.MinValue, name));
        byte[] told = AnyDatagram.Bytes(roster.Encode);
        bool isJoin = JoinDatagram.TryDecode(join, out _, out _);
        Assert.Equal(isJoin, new RosterDatagram().TryDecode(told, out _));
        return isJoin;
    }
}
