using System.IO;
using System.Text.Json;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Tests.Cli;
using Xunit;

namespace LagSim.Tests.Sweep;

/// <summary>Why a cell of the sweep does not pass, and how the tool tells it.</summary>
public sealed class SweepOutcomeTests
{
    private static readonly SweepOutcome Good = new() { Cell = new SweepCell(3, 20, 64_000, 50, true), ComparedShare = 0.9, LoadShare = 0.5 };

    [Fact]
    public void Shortfall_OfACellThatShowsAll_IsNone()
    {
        Assert.True(Good.IsGood && Good.Shortfall is null);
        Assert.True((Good with { TooSlow = 1, LoadShare = 0.81 }).IsGood);
    }

    [Theory]
    [InlineData(0, 0, 0.89996, 0, "A client compared only 89.9 % of the host's committed states; at least 90 % must be compared.")]
    [InlineData(2, 0, 1, 0, "2 of the accepted events did not reach a client; all must.")]
    [InlineData(0, 1, 1, 0, "1 of the committed states compared differed; none may.")]
    [InlineData(0, 0, 1, 2, "The link was too slow for 2 of the clients at 50 % load; up to 80 % it must not be.")]
    public void Shortfall_OfACellThatFails_NamesTheBound(long lost, long differed, double compared, int tooSlow, string sentence)
    {
        SweepOutcome outcome = Good with { Lost = lost, Differed = differed, ComparedShare = compared, TooSlow = tooSlow };
        Assert.False(outcome.IsGood);
        Assert.Equal(sentence, outcome.Shortfall);
        JsonElement cell = Json(outcome);
        Assert.Equal((sentence, false), (cell.GetProperty("failure").GetString(), cell.GetProperty("passed").GetBoolean()));
        Assert.Contains($"  3 clients, 20 events/s each, 64 kbit/s, queue 50 ms, dips: {sentence}", SweepTables.Footnotes([outcome]));
        Assert.Equal(compared < 0.9 ? "89 %" : "100 %", SweepTables.Cells(outcome)[15]); // rounded down: "90 %" would look as if it passed
    }

    [Fact]
    public void Shortfall_OfACellThatDidNotBegin_IsItsFailureAlone() =>
        Assert.Equal("Not all were in.", (Good with { ComparedShare = 0, Failure = "Not all were in." }).Shortfall);

    [Fact]
    public void Json_OfACellThatPasses_HasNoFailure() => Assert.Equal(JsonValueKind.Null, Json(Good).GetProperty("failure").ValueKind);

    [Fact]
    public void Help_OfTheSweep_HasEachDefaultOnce()
    {
        string help = Tool.Run("sweep", "--help").Done().OutputOnOneLine;
        Assert.Contains("default 3,8.", help, System.StringComparison.Ordinal);
        Assert.DoesNotContain("3|8", help, System.StringComparison.Ordinal);
    }

    [Fact]
    public void Sweep_OneCellOfOneClient_IsToldInTheSingular()
    {
        Tool tool = Tool.Run(
            "sweep", "--clients", "1", "--rate-kbps", "1000", "--queue-ms", "50", "--events", "5", "--no-dips", "--play-s", "3", "--rest-s", "2").Done();
        Assert.Contains("  1 client, 5 events/s each", tool.Error, System.StringComparison.Ordinal);
        Assert.Contains("The one cell: no accepted event lost", tool.Output, System.StringComparison.Ordinal);
    }

    private static JsonElement Json(SweepOutcome outcome)
    {
        using StringWriter output = new();
        SweepJson.Write(output, new SweepOptions(), [outcome], false);
        using JsonDocument document = JsonDocument.Parse(output.ToString());
        return document.RootElement.GetProperty("cells")[0].Clone();
    }
}
