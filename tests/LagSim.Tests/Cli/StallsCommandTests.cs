using System;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Stalls;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary><c>lagsim stalls</c>: what it prints, and what it refuses.</summary>
public sealed class StallsCommandTests
{
    [Theory]
    [InlineData("--sessions", "0", "between 1 and 1000000")]
    [InlineData("--sessions", "many", "between 1 and 1000000")]
    [InlineData("--worst", "-1", "between 0 and 1000")]
    [InlineData("--processes", "1001", "between 0 and 1000")]
    [InlineData("--processes", "1.5", "between 0 and 1000")]
    [InlineData("--seed", "-1", "between 0 and 18446744073709551615")]
    public void Stalls_NumberOutOfRange_IsRefusedWithOptionValueAndRange(string option, string value, string range) =>
        Tool.Refuses(2, ["stalls", option, value], option, $"'{value}'", range);

    [Theory]
    [InlineData("0")]
    [InlineData("3601")]
    public void Relay_ChangeOfPortsOutOfRange_IsRefused(string seconds) =>
        Tool.Refuses(2, ["relay", "127.0.0.1:5000", "--profile", "lan", "--change-port-s", seconds], "--change-port-s", $"'{seconds}'", "between 0.5 and 3600");

    [Fact]
    public void Stalls_TwoSessions_AreToldAsJsonAndPlayOneByOneWithTheSameFigures()
    {
        using JsonDocument both = JsonDocument.Parse(Tool.Run("stalls", "--sessions", "2", "--seed", "9", "--json").Done().Output);
        JsonElement root = both.RootElement;
        Assert.Equal(("stalls", 2, 0L, 0L), (
            root.GetProperty("command").GetString(), root.GetProperty("sessions").GetInt32(), root.GetProperty("states_differed").GetInt64(), root.GetProperty("events_lost").GetInt64()));
        Assert.Empty(root.GetProperty("failing_seeds").EnumerateArray());
        JsonElement worst = root.GetProperty("worst").EnumerateArray().First();
        string replay = worst.GetProperty("replay").GetString()!;
        Assert.StartsWith("lagsim stalls --sessions 1 --seed ", replay);

        using JsonDocument alone = JsonDocument.Parse(Tool.Run([.. replay.Split(' ').Skip(1), "--json"]).Done().Output);
        Assert.Equal(worst.GetRawText(), alone.RootElement.GetProperty("worst")[0].GetRawText());
        Assert.Equal(worst.GetProperty("recovery_s").GetDouble(), alone.RootElement.GetProperty("recovery_s").GetProperty("max").GetDouble());
    }

    [Fact]
    public void Stalls_AsText_NamesTheWorstWithItsCommand()
    {
        Tool tool = Tool.Run("stalls", "--sessions", "1", "--seed", "9").Done();
        Assert.Contains("states compared, 0 differ;", tool.Output);
        Assert.Contains("lagsim stalls --sessions 1 --seed 9", tool.Output);
        Assert.Contains("All of them are as they should be.", tool.Output);
        Assert.StartsWith("1 session, ", tool.Output, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(38)] // over a link of 2 s each way: with a history of a second alone, every event came too late
    [InlineData(9)]
    public void Stalls_Events_AreAllAccepted_AndCountedAlikeInSumAndRow(int seed)
    {
        string[] call = ["stalls", "--sessions", "1", "--seed", $"{seed}"];
        using JsonDocument document = JsonDocument.Parse(Tool.Run([.. call, "--json"]).Done().Output);
        JsonElement root = document.RootElement, row = root.GetProperty("worst")[0];
        long accepted = root.GetProperty("events_accepted").GetInt64();
        Assert.InRange(accepted, 1, long.MaxValue);
        Assert.All(["events_refused", "events_refused_too_late"], key => Assert.Equal(0, root.GetProperty(key).GetInt64()));
        Assert.Equal((accepted, 0), (row.GetProperty("events_accepted").GetInt64(), row.GetProperty("events_refused").GetInt64()));
        string text = Tool.Run(call).Done().Output;
        long expected = root.GetProperty("events_expected").GetInt64();
        Assert.InRange(expected, 2 * accepted, long.MaxValue); // each is to be heard of by every client that is there
        Assert.Equal(2, text.Split($"{NumberText.Count(accepted, "event")} accepted, 0 of {expected} lost on the way to clients, 0 refused").Length - 1); // in the sum and in the row
        Assert.DoesNotContain(" came too late)", text, StringComparison.Ordinal);
    }

    /// <summary>Where events were refused, the text says how many of them came too late: all, some or none.</summary>
    [Theory]
    [InlineData(0, 0, "0 refused")]
    [InlineData(3, 3, "3 refused (they came too late)")]
    [InlineData(3, 1, "3 refused (1 of them came too late)")]
    [InlineData(3, 0, "3 refused (0 of them came too late)")]
    public void Text_OfRefusedEvents_SaysHowManyCameTooLate(int refused, int late, string expected)
    {
        using StringWriter text = new();
        StallOutcome outcome = new() { Case = new StallCase(9), Accepted = 7, Expected = 14, Compared = 1, Refused = refused, RefusedTooLate = late };
        StallsText.Write(text, [outcome], [outcome], []);
        string[] lines = text.ToString().Split(Environment.NewLine);
        string sentence = $"7 events accepted, 0 of 14 lost on the way to clients, {expected}";
        Assert.Contains($"    {sentence}", lines);
        Assert.Contains($"; {sentence}; ", lines[0], StringComparison.Ordinal);
    }

    [Fact]
    public void Stalls_WithProcesses_TellsWhichSessionIsPlayedAndHowLongItTakes()
    {
        Assert.SkipWhen(OperatingSystem.IsWindows(), "Windows has no signals to stop processes by.");
        using StringWriter output = new(), error = new();
        ToolConsole console = new(output, error, TestContext.Current.CancellationToken);
        Command command = StallsCommand.Create(console, null, ["false"]); // so that no session begins, and none takes its time
        int code = command.Parse(["--sessions", "1", "--seed", "9", "--processes", "1"])
            .Invoke(new InvocationConfiguration { Output = output, Error = error, EnableDefaultExceptionHandler = false });
        Assert.Equal(1, code);
        string[] lines = error.ToString().Split(Environment.NewLine);
        Assert.Contains(lines, line => line.StartsWith("1 session again with processes, 1 at a time, in about ", StringComparison.Ordinal));
        Assert.Contains(lines, line => line.StartsWith("  seed 9: begins, and takes about ", StringComparison.Ordinal) && line.EndsWith($" s: {new StallCase(9)}", StringComparison.Ordinal));
        Assert.Contains("  seed 9: not good: The host does not listen: it said nothing. (1 of 1 done)", lines);
    }

    [Fact]
    public void SecondsOfAll_SeveralAtATime_IsUntilTheLastIsDone()
    {
        Assert.Equal(60, StallsCommand.SecondsOfAll([10, 20, 30, 40], 2));
        Assert.Equal(100, StallsCommand.SecondsOfAll([10, 20, 30, 40], 1));
        Assert.Equal(40, StallsCommand.SecondsOfAll([10, 20, 30, 40], 4));
    }
}
