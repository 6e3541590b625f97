using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Threading;
using LagSim.Cli;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;
using static LagSim.Tests.Cli.DropCommandTests;

namespace LagSim.Tests.Cli;

public sealed class CompareCommandTests
{
    private static readonly string[] Head = ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash"];

    private static readonly string[] RunKeys =
    [
        "case", "strategy", "motion", "time", "transport", "profile", "delay_ms", "peers", "seen", "seen_true_time", "settled", "state_hashes", "event_hashes",
        "clock_error_ms", "events", "heals", "bytes_sent_per_s", "event_lateness_ms", "cpu_cores_at_rest", "time_to_heal_ms", "events_rerun", "cone_bodies",
        "corrections_seen_m", "corrections_seen", "seen_from_truth", "truth_state_hash", "truth_event_hash", "divergence_ms", "input_latency_ms", "display_delay_ms",
    ];

    [Fact]
    public void Json_OfAComparison_HasExactlyTheKeysOfTheContract()
    {
        JsonElement document = Json("compare", "--scene", "billiards", "--profile", "delay-100ms", "--json");
        Assert.Equal([.. Head, "plan", "runs", "interpolation_better_during", "healing_worse_after"], Keys(document));
        Assert.Equal(("compare", "billiards"), (Text(document, "command"), Text(document, "scene")));
        Assert.Matches("^[0-9a-f]{16}$", Text(document, "scene_hash"));
        JsonElement[] plan = document.GetProperty("plan").EnumerateArray().ToArray();
        Assert.Equal(12, plan.Length);
        Assert.All(plan, action => Assert.Equal(["time_s", "peer", "kind", "body"], Keys(action)));

        JsonElement[] runs = document.GetProperty("runs").EnumerateArray().ToArray();
        Assert.Equal(LateEventStrategies.Names, runs.Select(run => Text(run, "strategy")));
        foreach (JsonElement run in runs)
        {
            Assert.Equal(RunKeys, Keys(run));
            Assert.Equal(("plan", "ballistic", "virtual", "virtual", "delay-100ms"), (Text(run, "case"), Text(run, "motion"), Text(run, "time"), Text(run, "transport"), Text(run, "profile")));
            Assert.Equal(4, run.GetProperty("state_hashes").GetArrayLength());
            Assert.Equal(4, run.GetProperty("bytes_sent_per_s").GetArrayLength());
            foreach (string percentiles in new[] { "time_to_heal_ms", "corrections_seen_m", "event_lateness_ms", "divergence_ms", "input_latency_ms" })
            {
                Assert.Equal(["p50", "p99", "max"], Keys(run.GetProperty(percentiles)));
            }

            Assert.Equal(["mean", "p99"], Keys(run.GetProperty("events_rerun")));
            Assert.Equal(["mean", "p99"], Keys(run.GetProperty("cone_bodies")));
            foreach (string compared in new[] { "seen", "seen_true_time", "settled", "seen_from_truth" })
            {
                Assert.Equal(["before", "during", "after"], Keys(run.GetProperty(compared)));
            }

            bool promises = LateEventStrategies.Create(Text(run, "strategy")).PromisesAgreement;
            Assert.Equal(promises, run.GetProperty("seen").GetProperty("after").GetProperty("differing_bits").GetInt64() == 0);
            Assert.Equal(promises, Text(run, "truth_state_hash") == run.GetProperty("state_hashes")[3].GetString());
            Assert.Equal(Text(run, "strategy") == "interpolation" ? 100 : 0, run.GetProperty("display_delay_ms").GetDouble(), 1e-6);
        }

        Assert.Equal("delay-100ms", document.GetProperty("interpolation_better_during")[0].GetString());
        Assert.Equal(0, document.GetProperty("healing_worse_after").GetArrayLength());
    }

    [Fact]
    public void Strategy_AndDelayAndPeersAndSeed_AreTaken()
    {
        JsonElement document = Json("compare", "--profile", "lan", "--strategy", "interpolation", "--display-delay-ms", "250", "--peers", "3", "--seed", "9", "--json");
        JsonElement run = document.GetProperty("runs").EnumerateArray().Single();
        Assert.Equal(("pair", 9UL), (Text(document, "scene"), document.GetProperty("seed").GetUInt64()));
        Assert.Equal(250, run.GetProperty("display_delay_ms").GetDouble(), 1e-6);
        Assert.Equal(3, run.GetProperty("peers").GetInt32());
        Assert.InRange(run.GetProperty("input_latency_ms").GetProperty("p50").GetDouble(), 250, 255.01);
        Assert.Equal(Text(document, "state_hash"), Text(run, "truth_state_hash"));
    }

    [Fact]
    public void Table_OfEveryLink_HasARowForEachAndSaysWhatFollows()
    {
        Tool tool = Tool.Run("compare", "--scene", "pair", "--peers", "2").Done();
        string[] lines = tool.Output.Split('\n');
        foreach (LinkProfile link in LinkProfiles.All)
        {
            Assert.All(LateEventStrategies.Names, name => Assert.Single(lines, line => line.Split((char[]?)null, StringSplitOptions.RemoveEmptyEntries).Take(2).SequenceEqual([link.Name, name])));
        }

        Assert.Contains("After the events healing is nowhere worse than another strategy.", tool.Output, StringComparison.Ordinal);
        Assert.Matches($@"interpolation looks better than healing on \d+ of {LinkProfiles.All.Count} links: .*lan", tool.Output);
        Assert.DoesNotContain("\u001b", tool.Output + tool.Error, StringComparison.Ordinal);
        string[] told = tool.Error.Split(Environment.NewLine, StringSplitOptions.RemoveEmptyEntries);
        Assert.Equal("compare, pair, virtual time ...", told[0]);
        Assert.Equal(LinkProfiles.All.SelectMany(link => LateEventStrategies.Names.Select(name => $"  {link.Name}, {name}")), told[1..]); // a line a run, where no bar is
        Assert.All(lines.Where(line => line.Contains("  interpolation  ", StringComparison.Ordinal)), line => Assert.InRange(line.TrimEnd().Length, 1, 110));
    }

    [Fact]
    public void Out_OfAComparison_HasPicturesNumbersAndAPageThatShowsThem()
    {
        using TemporaryFolder folder = new();
        Tool.Run("compare", "--scene", "drop", "--profile", "4g", "--out", folder["new/one"]).Done();
        string[] files = Directory.GetFiles(folder["new/one"]).Select(file => Path.GetFileName(file)!).Order(StringComparer.Ordinal).ToArray();
        Assert.Equal(["compare-4g.csv", "compare-4g.svg", "compare-plan.csv", "compare.csv", "report.html"], files);
        Assert.Equal(6, File.ReadAllLines(folder["new/one/compare.csv"]).Length);
        Assert.Equal(13, File.ReadAllLines(folder["new/one/compare-plan.csv"]).Length);
        Assert.Equal(1 + (5 * 2399), File.ReadLines(folder["new/one/compare-4g.csv"]).Count());
        string page = File.ReadAllText(folder["new/one/report.html"]);
        Assert.Equal(1, page.Split("<svg").Length - 1);
        Assert.Contains("nowhere worse", page, StringComparison.Ordinal);

        // A panel a strategy, each with a legend: no curve lies under another's.
        string chart = File.ReadAllText(folder["new/one/compare-4g.svg"]);
        Assert.Equal(10, chart.Split("class=\"line c0\"").Length - 1);
    }

    [Theory]
    [InlineData("--scene", "no-such", 3, "no-such: this is neither a built-in scene", "billiards")]
    [InlineData("--scene", "crowd-501", 2, "501 bodies", "at most 500")]
    [InlineData("--scene", "crowd-500", 2, "500 bodies, and players spawn 2 more", "at most 500")]
    [InlineData("--profile", "moon", 2, "'moon'", "loopback, lan")]
    [InlineData("--strategy", "hope", 2, "--strategy is 'hope'", "none, latency-forward, interpolation, full-rollback, healing, all")]
    [InlineData("--peers", "1", 2, "--peers is '1'", "between 2 and 9")]
    [InlineData("--peers", "10", 2, "--peers is '10'", "between 2 and 9")]
    [InlineData("--display-delay-ms", "-1", 2, "--display-delay-ms is '-1'", "between 0 and 5000")]
    [InlineData("--display-delay-ms", "5001", 2, "--display-delay-ms is '5001'", "between 0 and 5000")]
    [InlineData("--seed", "x", 2, "--seed is 'x'", "between 0 and")]
    public void Option_OutOfRange_IsRefusedWithWhatIsAllowed(string option, string value, int code, string names, string allowed) =>
        Tool.Refuses(code, ["compare", option, value], names, allowed);

    [Theory]
    [InlineData("compare")]
    [InlineData("hold")]
    public void DisplayDelay_OfAStrategyThatHasNone_IsRefused(string command)
    {
        Tool.Refuses(2, [command, "--strategy", "healing", "--display-delay-ms", "100"], "--display-delay-ms is for the strategy interpolation alone, and --strategy is 'healing'");
        Tool.Refuses(2, [command, "--strategy", "interpolation", "--display-delay-ms", "100", "--profile", "moon"], "'moon'"); // not refused for that
    }

    [Fact]
    public void Compare_Interrupted_LeavesNoFolder()
    {
        using TemporaryFolder folder = new();
        using StringWriter output = new(), error = new();
        Assert.Equal(130, Program.Run(["compare", "--out", folder["new/one"]], output, error, new CancellationToken(canceled: true)));
        Assert.Equal("", output.ToString());
        Assert.Empty(Directory.GetFileSystemEntries(folder.Path));
    }

    [Fact]
    public void ExitCodeOf_PromiseKeptOrNotGiven_IsZero() => Assert.Equal(0, CompareCommand.ExitCodeOf([Run("healing"), Run("none")]));

    [Fact]
    public void ExitCodeOf_PromiseBroken_IsOneAndTold()
    {
        CompareRun broken = As(Run("none"), "healing");
        Assert.Equal(1, CompareCommand.ExitCodeOf([Run("full-rollback"), broken]));
        Assert.Null(Run("healing").FirstDifference);
        SettledDifference first = broken.FirstDifference!;
        Assert.Contains(broken.Options.Scene.Bodies, body => body.Name == first.Body);
        Assert.InRange(first.Peer, 0, broken.Options.Peers - 1);
        Assert.Contains(
            FormattableString.Invariant($"NOT equal: with healing on delay-100ms not all peers settled on the same. The first body that differs is '{first.Body}', of peer {first.Peer} at T {first.Seconds} s."),
            CompareTables.Footnotes([broken]));
        Assert.Equal(1, CompareCommand.ExitCodeOf([Run("healing") with { TruthStateHash = 1 }])); // all the same, and all wrong
    }

    [Fact]
    public void Findings_OfOtherFigures_AreOthers()
    {
        // What the sentences say follows from the runs: with the strategies' names exchanged they say the opposite.
        CompareRun healing = Run("healing"), interpolation = Run("interpolation"), none = Run("none");
        CompareFindings asItIs = new([interpolation, healing, none]);
        Assert.Equal(["delay-100ms"], asItIs.BetterDuring);
        Assert.Empty(asItIs.HealingWorseAfter);
        Assert.Contains(asItIs.Sentences(), sentence => sentence.Contains("nowhere worse", StringComparison.Ordinal));

        CompareFindings exchanged = new([As(healing, "interpolation"), As(interpolation, "healing")]);
        Assert.Empty(exchanged.BetterDuring);
        Assert.Contains(exchanged.Sentences(), sentence => sentence.Contains("on no link here", StringComparison.Ordinal));

        CompareFindings worse = new([healing with { Options = healing.Options with { Strategy = "full-rollback" } }, As(none, "healing")]);
        Assert.Equal([("delay-100ms", "full-rollback")], worse.HealingWorseAfter);
        Assert.Contains("After the events healing is worse than full-rollback on delay-100ms.", worse.Sentences());
        Assert.Empty(new CompareFindings([healing]).Sentences()); // nothing to compare it with
    }

    private static CompareRun As(CompareRun run, string strategy) => run with { Options = run.Options with { Strategy = strategy } };

    private static CompareRun Run(string strategy)
    {
        Scene scene = BuiltInScenes.Billiards();
        return CompareTest.Run(new CompareOptions(scene, PlayerPlan.Draw(scene, 4, 1), strategy, LinkProfiles.PureDelay(100)));
    }
}
