using System;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Threading;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Verification.Check;
using LagSim.Net.Sessions;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
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
        string page = File.ReadAllText(folder["out/report.html"]);
        Assert.Contains("No bit differed and no accepted event was lost in 3 sessions.", page, StringComparison.Ordinal);
    }

    [Fact]
    public void Check_FailingSeed_EndsWithOneAndItsCommandFailsAgain()
    {
        using TemporaryFolder folder = new();
        Tool tool = Tool.Run(
            "check", "--sessions", "1", "--seed", "2", "--peers", "3", "--profile", "delay-200ms", "--strategy", "none", "--json",
            "--out", folder["out"]);
        Assert.Contains("1 of 1 session failed.", File.ReadAllText(folder["out/report.html"]), StringComparison.Ordinal);
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
    public void Check_FaultInOneWorld_IsShrunkAndTheCommandItPrintsFailsWithItAlone()
    {
        // The whole way: found among several sessions, made small, printed as a command, and that command given to the tool again.
        static void Wrong(int peer, Session session) =>
            session.Put(new FaultyEngineParts { Healing = peer == 1 ? HealingFault.CutsByTime : HealingFault.None });

        (int code, string output) = Run(["check", "--sessions", "2", "--seed", "15", "--peers", "2-4"], Wrong);
        Assert.Equal(1, code);
        string[] commands = [.. output.Split('\n').Select(line => line.Trim()).Where(line => line.StartsWith("lagsim check ", StringComparison.Ordinal))];
        Assert.NotEmpty(commands);
        string[] least = commands[0].Split(' ');
        Assert.Equal(["--sessions", "1", "--peers", "2-4", "--bodies"], least[4..9]);
        Assert.InRange(least[9].Split(',').Length, 1, 3);
        Assert.InRange(least[11].Split(',').Length, 1, 4);
        string difference = output.Split('\n').First(line => line.Contains("first difference", StringComparison.Ordinal)).Trim();
        Assert.Contains("Peer 1,", difference, StringComparison.Ordinal);

        (int again, string replayed) = Run(least[1..], Wrong);
        Assert.Equal(1, again);
        Assert.Contains("1 of 1 session ", replayed, StringComparison.Ordinal);
        Assert.Contains(difference["first difference of the least that fails: ".Length..], replayed, StringComparison.Ordinal);
        Assert.Contains(commands[0], replayed, StringComparison.Ordinal); // nothing more can be left out
        Assert.Equal(0, Run(least[1..], null).Code);
    }

    [Fact]
    public void Check_MoreFailingSeedsThanAreShrunk_SaysWhichAreNotAndHowToShrinkOne()
    {
        string[] arguments = ["check", "--sessions", "5", "--seed", "2", "--peers", "3", "--profile", "delay-200ms", "--strategy", "none"];
        (int code, string output) = Change(arguments, options => options with { ShrinkingPlays = 1 });
        Assert.Equal(1, code);
        Assert.Contains("failing seeds 5", output, StringComparison.Ordinal);
        const string Left = "lagsim check --seed 5 --sessions 1 --peers 3 --profile delay-200ms --strategy none";
        Assert.Contains($"seeds 2, 3, 4 shrunk; 2 more failing seeds not shrunk: {Left} shrinks the first of them", output, StringComparison.Ordinal);
        Assert.Contains($"  {Left}", output.Split('\n').Select(line => line.TrimEnd())); // the command of that seed, which shrinks it

        (_, string alone) = Change(["check", "--sessions", "1", .. arguments[3..]], options => options with { ShrinkingPlays = 1 });
        Assert.DoesNotContain("not shrunk", alone, StringComparison.Ordinal); // the control
        Assert.Contains(" --bodies ", alone, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Check_Interrupted_TellsOfTheSessionsThatWereDone(bool json)
    {
        using CancellationTokenSource stop = new();
        int begun = 0;
        void Watch(int peer, Session session) => session.Begun += StopAtTheFortieth;
        void StopAtTheFortieth()
        {
            if (Interlocked.Increment(ref begun) == 40)
            {
                stop.Cancel();
            }
        }

        string[] asked = ["check", "--sessions", "100000", "--seed", "10", .. json ? ["--json"] : Array.Empty<string>()];
        (int code, string output) = Run(asked, Watch, stop);
        Assert.Equal(130, code);
        if (json)
        {
            JsonElement told = JsonDocument.Parse(output).RootElement;
            Assert.True(told.GetProperty("stopped_early").GetBoolean());
            Assert.Equal(100_000, told.GetProperty("sessions_asked_for").GetInt32());
            Assert.InRange(told.GetProperty("sessions").GetInt32(), 1, 40);
            Assert.InRange(told.GetProperty("stopped_seeds").GetArrayLength(), 1, Environment.ProcessorCount);
            return;
        }

        Assert.Matches("^stopped early: [0-9,]+ of 100,000 sessions played from seed 10 ", output);
        Assert.Matches("(?m)^stopped in the middle of the sessions? of seeds? [0-9, ]+, which (is|are) not counted; lagsim check --sessions 1 --seed [0-9]+ plays ", output);
        Assert.Contains("failing seeds 0", output, StringComparison.Ordinal);
    }

    private static (int Code, string Output) Run(string[] arguments, Action<int, Session>? prepare, CancellationTokenSource? stop = null) =>
        Change(arguments, options => options with { PrepareSession = prepare }, stop);

    private static (int Code, string Output) Change(string[] arguments, Func<CheckOptions, CheckOptions> change, CancellationTokenSource? stop = null)
    {
        using StringWriter output = new(), error = new();
        Command command = CheckCommand.Create(new ToolConsole(output, error, stop?.Token ?? TestContext.Current.CancellationToken), change);
        return (command.Parse(arguments[1..]).Invoke(new InvocationConfiguration { Output = output, Error = error, EnableDefaultExceptionHandler = false }), output.ToString());
    }

    [Fact]
    public void Check_WorldsAlone_PlaysNoSessionAndSaysWhatTheContractNames()
    {
        JsonElement json = JsonDocument.Parse(Tool.Run("check", "--worlds", "14", "--seed", "1400", "--json").Done().Output).RootElement;
        Assert.Equal((0, 14), (json.GetProperty("sessions").GetInt32(), json.GetProperty("worlds").GetInt32()));
        Assert.Equal((0, 0, 0), (json.GetProperty("worlds_ended").GetInt32(), json.GetProperty("worlds_differing").GetInt32(), json.GetProperty("broken_promises").GetInt32()));
        Assert.Equal((14, 0), (json.GetProperty("world_kinds").GetArrayLength(), json.GetProperty("failing_worlds").GetArrayLength()));
        string text = Tool.Run("check", "--worlds", "2", "--sessions", "1", "--seed", "1400").Done().Output;
        Assert.Contains("1 of 1 session played", text, StringComparison.Ordinal);
        Assert.Contains("2 of 2 worlds played from seed 1400", text, StringComparison.Ordinal);
    }

    [Fact]
    public void Check_WrongArguments_NamesThem()
    {
        Tool.Refuses(2, ["check", "--worlds", "0"], "--worlds is '0'");
        Tool.Refuses(2, ["check", "--worlds", "1", "--bodies", "1"], "leave out --worlds");
        Tool.Refuses(2, ["check", "--peers", "1-3"], "--peers is '1-3'", "2 to 8");
        Tool.Refuses(2, ["check", "--peers", "x"], "--peers is 'x'");
        Tool.Refuses(2, ["check", "--sessions", "0"], "--sessions is '0'");
        Tool.Refuses(2, ["check", "--profile", "nowhere"], "nowhere");
        Tool.Refuses(2, ["check", "--bodies", "1"], "--sessions 1 instead of 1000");
        Tool.Refuses(2, ["check", "--sessions", "1", "--bodies", "a"], "--bodies is 'a'");
        Tool.Refuses(2, ["check", "--sessions", "1", "--events", "4,3"], "4,3", "ascending");
    }
}
