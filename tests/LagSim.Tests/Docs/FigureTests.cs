using System.Globalization;
using System.Linq;
using System.Text.Json;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using Xunit;
using static LagSim.Tests.Cli.DropCommandTests;

namespace LagSim.Tests.Docs;

/// <summary>Figures of the documents that are the same bits on every machine are those that the tool gives now: of virtual time, not of clocks.</summary>
public sealed class FigureTests
{
    [Fact]
    public void Strategies_TableOfThePage_IsWhatCompareGives()
    {
        string page = SnippetTests.Read("docs/STRATEGIES.md");
        JsonElement[] runs = Json("compare", "--scene", "billiards", "--profile", "transatlantic", "--json").GetProperty("runs").EnumerateArray().ToArray();
        Assert.Equal(5, runs.Length);
        foreach (JsonElement run in runs)
        {
            JsonElement seen = run.GetProperty("seen");
            string[] cells =
            [
                $"`{run.GetProperty("strategy").GetString()}`",
                Metres(seen.GetProperty("during").GetProperty("max_m")), Metres(seen.GetProperty("after").GetProperty("max_m")),
                Metres(run.GetProperty("seen_from_truth").GetProperty("after").GetProperty("max_m")), Metres(run.GetProperty("corrections_seen_m").GetProperty("max")),
                run.GetProperty("events_rerun").GetProperty("mean").GetDouble().ToString("F1", CultureInfo.InvariantCulture),
                run.GetProperty("cone_bodies").GetProperty("mean").GetDouble().ToString("F0", CultureInfo.InvariantCulture),
            ];
            Assert.Contains($"| {string.Join(" | ", cells)} |", page, System.StringComparison.Ordinal);
        }
    }

    [Fact]
    public void Idle_BytesASecondOfReadmeSessionsAndLinks_AreWhatTheSweepGivesWithAndWithoutHeaders()
    {
        const double Headers = 28 * 0.5; // of UDP and IP, for the datagram that goes each way every 2 s
        JsonElement cell = Json("sweep", "--clients", "3", "--events", "0", "--rate-kbps", "256", "--queue-ms", "50", "--no-dips", "--play-s", "60", "--rest-s", "1", "--json")
            .GetProperty("cells")[0];
        double down = cell.GetProperty("sent_bytes_per_s").GetDouble(), up = cell.GetProperty("sent_up_bytes_per_s").GetDouble();
        string both = $"{Whole(up - Headers)} bytes a second up and {Whole(down - Headers)} down, or {Whole(up)} and {Whole(down)} with UDP and IP headers";
        Assert.Contains(both, SnippetTests.Read("README.md"), System.StringComparison.Ordinal);
        Assert.Contains(both, SnippetTests.Read("docs/SESSIONS.md"), System.StringComparison.Ordinal);
        Assert.Contains(
            $"sent {Whole(down)} bytes a second with those headers ({Whole(down - Headers)} without", SnippetTests.Read("docs/LINKS.md"), System.StringComparison.Ordinal);

        static string Whole(double bytes) => System.Math.Round(bytes, System.MidpointRounding.AwayFromZero).ToString(CultureInfo.InvariantCulture);
    }

    [Theory]
    [InlineData("docs/SECURITY.md", "one handshake a second is read from each machine, {0} at once after a pause, and 250 a second from all together")]
    [InlineData("src/LagSim.Net/README.md", "A host and up to {0} players")]
    public void Limits_ThatPagesTell_AreThoseOfTheCode(string page, string sentence)
    {
        JoinLimits limits = new();
        Assert.Equal((1.0, 16, 250.0, 16), (limits.HandshakesPerSecond, limits.HandshakeBurst, limits.HandshakesPerSecondOfAll, SessionOptions.MaxClients));
        string text = SnippetTests.Read(page);
        Assert.Contains(string.Format(CultureInfo.InvariantCulture, sentence, "sixteen"), text, System.StringComparison.Ordinal);
        Assert.DoesNotContain(string.Format(CultureInfo.InvariantCulture, sentence, "eight"), text, System.StringComparison.Ordinal); // what they told
    }

    private static string Metres(JsonElement figure) => figure.GetDouble() == 0 ? "0" : figure.GetDouble().ToString("F2", CultureInfo.InvariantCulture);
}
