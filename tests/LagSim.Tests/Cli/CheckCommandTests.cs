using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary><c>lagsim check</c>.</summary>
public sealed class CheckCommandTests
{
    [Fact]
    public void Check_FewSessions_SaysWhatTheContractNames()
    {
        using TemporaryFolder folder = new();
        JsonElement json = JsonDocument.Parse(Tool.Run("check", "--sessions", "3", "--seed", "7", "--json", "--out", folder["out"]).Done().Output).RootElement;
        Assert.Equal("check", json.GetProperty("command").GetString());
        Assert.Equal(3, json.GetProperty("sessions").GetInt32());
        foreach (string key in new[] { "events", "external_events", "late_events", "heals", "heals_that_changed_an_impact" })
        {
            Assert.True(json.GetProperty(key).GetInt64() > 0, key);
        }

        Assert.Equal((0, 0, 0), (json.GetProperty("too_late_events").GetInt32(), json.GetProperty("differing_bits").GetInt32(), json.GetProperty("failing_seeds").GetArrayLength()));
        string[] rows = File.ReadAllLines(folder["out/check.csv"]);
        Assert.Equal(4, rows.Length);
        Assert.StartsWith("7,", rows[1], StringComparison.Ordinal);
        Assert.True(File.Exists(folder["out/report.html"]));
    }

    [Fact]
    public void Check_FailingSeed_EndsWithOneAndItsCommandFailsAgain()
    {
        Tool tool = Tool.Run("check", "--sessions", "1", "--seed", "2", "--peers", "3", "--profile", "delay-200ms", "--strategy", "none", "--json");
        Assert.Equal(1, tool.ExitCode);
        JsonElement json = JsonDocument.Parse(tool.Output).RootElement;
        Assert.Equal(2, json.GetProperty("failing_seeds").EnumerateArray().Single().GetInt32());
        JsonElement failure = json.GetProperty("failures")[0];
        Assert.NotEqual(JsonValueKind.Null, failure.GetProperty("first_difference").ValueKind);
        string[] command = failure.GetProperty("replay").GetString()!.Split(' ');
        Assert.Equal(["lagsim", "check", "--seed", "2", "--sessions", "1", "--peers", "3", "--profile", "delay-200ms", "--strategy", "none", "--bodies"], command[..13]);
        Tool again = Tool.Run(command[1..]);
        Assert.Equal(1, again.ExitCode);
        Assert.Contains("seed 2: ", again.Output, StringComparison.Ordinal);
        Assert.Contains("expected ", again.Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Check_WrongArguments_NamesThem()
    {
        Tool.Refuses(2, ["check", "--peers", "1-3"], "--peers is '1-3'", "2 to 8");
        Tool.Refuses(2, ["check", "--peers", "x"], "--peers is 'x'");
        Tool.Refuses(2, ["check", "--sessions", "0"], "--sessions is '0'");
        Tool.Refuses(2, ["check", "--profile", "nowhere"], "nowhere");
        Tool.Refuses(2, ["check", "--bodies", "1"], "--sessions 1 instead of 1000");
        Tool.Refuses(2, ["check", "--sessions", "1", "--bodies", "a"], "--bodies is 'a'");
        Tool.Refuses(2, ["check", "--sessions", "1", "--events", "4,3"], "4,3", "ascending");
    }
}
