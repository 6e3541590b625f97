using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Text.RegularExpressions;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Drop;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using Xunit;

namespace LagSim.Tests.Cli;

public sealed class DropCommandTests
{
    private static readonly string[] Head = ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash"];

    private static readonly string[] RunKeys =
    [
        "case", "strategy", "motion", "time", "transport", "profile", "delay_ms", "peers", "seen", "seen_true_time", "settled", "state_hashes", "event_hashes",
        "clock_error_ms", "events", "heals", "bytes_sent_per_s", "event_lateness_ms", "cpu_cores_at_rest",
    ];

    private static readonly string[] ErrorKeys = ["samples", "max_m", "mean_m", "rms_m", "differing_bits", "stalled_samples"];

    [Fact]
    public void Json_OfADrop_HasExactlyTheKeysOfTheContract()
    {
        JsonElement document = Json("drop", "--time", "virtual", "--json");
        Assert.Equal([.. Head, "runs"], Keys(document));
        Assert.Equal(("lagsim", "drop", "drop", 1UL), (Text(document, "tool"), Text(document, "command"), Text(document, "scene"), document.GetProperty("seed").GetUInt64()));
        Assert.Matches("^[0-9a-f]{16}$", Text(document, "scene_hash"));
        Assert.Equal(JsonValueKind.Null, document.GetProperty("state_hash").ValueKind); // the two cases end in two states

        JsonElement[] runs = document.GetProperty("runs").EnumerateArray().ToArray();
        Assert.Equal(["same-start", "teleport"], runs.Select(run => Text(run, "case")));
        foreach (JsonElement run in runs)
        {
            Assert.Equal(RunKeys, Keys(run));
            Assert.Equal(("healing", "rk4", "virtual", "virtual"), (Text(run, "strategy"), Text(run, "motion"), Text(run, "time"), Text(run, "transport")));
            Assert.Equal(JsonValueKind.Null, run.GetProperty("profile").ValueKind);
            Assert.Equal(25, run.GetProperty("delay_ms").GetDouble());
            Assert.Equal(2, run.GetProperty("peers").GetInt32());
            foreach (string compared in new[] { "seen", "seen_true_time", "settled" })
            {
                Assert.Equal(["before", "during", "after"], Keys(run.GetProperty(compared)));
                Assert.All(run.GetProperty(compared).EnumerateObject(), phase => Assert.Equal(ErrorKeys, Keys(phase.Value)));
            }

            Assert.All(run.GetProperty("settled").EnumerateObject(), phase => Assert.Equal(0, phase.Value.GetProperty("differing_bits").GetInt64()));
            string?[] hashes = run.GetProperty("state_hashes").EnumerateArray().Select(hash => hash.GetString()).ToArray();
            Assert.Equal(2, hashes.Length);
            Assert.Single(hashes.Distinct());
            Assert.Matches("^[0-9a-f]{16}$", hashes[0]);
            Assert.Equal(2, run.GetProperty("bytes_sent_per_s").GetArrayLength());
            Assert.Equal(["p50", "p99", "max"], Keys(run.GetProperty("event_lateness_ms")));
            Assert.Equal(JsonValueKind.Null, run.GetProperty("cpu_cores_at_rest").ValueKind); // nothing to measure in virtual time
        }

        Assert.Equal(0, runs[0].GetProperty("seen").GetProperty("before").GetProperty("max_m").GetDouble());
        Assert.Equal(0, runs[0].GetProperty("seen").GetProperty("during").GetProperty("samples").GetInt64());
        Assert.True(runs[1].GetProperty("seen").GetProperty("during").GetProperty("max_m").GetDouble() > 14);
    }

    [Fact]
    public void Json_SameCallTwice_IsTheSameToTheByte()
    {
        string[] call = ["drop", "--time", "virtual", "--profile", "awful", "--motion", "ballistic", "--peers", "3", "--json", "--seed", "18446744073709551615"];
        string first = Tool.Run(call).Done().Output;
        Assert.Equal(first, Tool.Run(call).Output);
        Assert.NotEqual(first, Tool.Run([.. call[..^1], "7"]).Output);
        using JsonDocument document = JsonDocument.Parse(first);
        Assert.Equal(ulong.MaxValue, document.RootElement.GetProperty("seed").GetUInt64());
        Assert.Equal("awful", Text(document.RootElement.GetProperty("runs")[0], "profile"));
        Assert.Equal(JsonValueKind.Null, document.RootElement.GetProperty("runs")[0].GetProperty("delay_ms").ValueKind);
    }

    [Fact]
    public void Json_OfAllStrategies_HasARunOfEachOnTheTeleportCase()
    {
        JsonElement[] runs = Json("drop", "--time", "virtual", "--motion", "ballistic", "--strategy", "all", "--json").GetProperty("runs").EnumerateArray().ToArray();
        Assert.Equal(["none", "latency-forward", "interpolation", "full-rollback", "healing"], runs.Skip(2).Select(run => Text(run, "strategy")));
        Assert.All(runs.Skip(2), run => Assert.Equal("teleport", Text(run, "case")));
        Assert.Equal([true, false, false, false, false], runs.Skip(2).Select(run => Differing(run) > 0));
    }

    [Theory]
    [InlineData("same-start")]
    [InlineData("teleport")]
    public void Case_Alone_RunsOnlyThatAndHasOneStateHash(string which)
    {
        JsonElement document = Json("drop", "--time", "virtual", "--case", which, "--json");
        JsonElement run = document.GetProperty("runs").EnumerateArray().Single();
        Assert.Equal(which, Text(run, "case"));
        Assert.Equal(Text(document, "state_hash"), run.GetProperty("state_hashes")[0].GetString());
    }

    [Theory]
    [InlineData("same-start", false)]
    [InlineData("teleport", true)]
    public void Case_Alone_ComparesStrategiesOnlyWhereOneBallIsLifted(string which, bool isCompared)
    {
        using TemporaryFolder folder = new();
        Tool tool = Tool.Run("drop", "--time", "virtual", "--motion", "ballistic", "--case", which, "--out", folder.Path).Done();
        Assert.Equal(isCompared, tool.Output.Contains("every strategy", StringComparison.Ordinal));
        Assert.Equal(isCompared, tool.Error.Contains("every strategy", StringComparison.Ordinal));
        Assert.Equal(isCompared, File.Exists(folder["drop-strategies.csv"]));
    }

    [Fact]
    public void Strategy_None_IsReportedAsItIsAndIsNoFailure()
    {
        JsonElement run = Json("drop", "--time", "virtual", "--case", "teleport", "--strategy", "none", "--json").GetProperty("runs")[0];
        Assert.True(Differing(run) > 3000);
    }

    [Fact]
    public void Options_OfTheScene_ChangeWhatTheyName()
    {
        JsonElement usual = Json("drop", "--time", "virtual", "--case", "same-start", "--json");
        foreach (string[] change in new string[][] { ["--height-m", "9"], ["--restitution", "0.5"], ["--rate-hz", "100"], ["--motion", "ballistic"] })
        {
            JsonElement changed = Json(["drop", "--time", "virtual", "--case", "same-start", "--json", .. change]);
            Assert.NotEqual(Text(usual, "scene_hash"), Text(changed, "scene_hash"));
            Assert.NotEqual(Events(usual), Events(changed));
        }

        static long Events(JsonElement document) => document.GetProperty("runs")[0].GetProperty("events").GetInt64();
    }

    [Fact]
    public void Table_OfADrop_PutsTheThesissFigureBesideOurs()
    {
        Tool tool = Tool.Run("drop", "--time", "virtual").Done();
        Assert.DoesNotContain("  metres", tool.Output, StringComparison.Ordinal); // no title is broken in two
        foreach (string expected in new[] { "same-start", "teleport", "at true time", "as settled, after", "none", "latency-forward", "interpolation shows everything 100 ms late", "(equal)" })
        {
            Assert.Contains(expected, tool.Output, StringComparison.Ordinal);
        }

        string[] lines = tool.Output.Split('\n');
        int ours = Array.FindIndex(lines, line => line.Contains("as seen, after", StringComparison.Ordinal));
        Assert.Matches(@"thesis, after\s+0\.084\s+0\.022\s+0\.029", lines[ours + 1]);
        Assert.DoesNotContain("\u001b", tool.Output + tool.Error, StringComparison.Ordinal); // no colours where no terminal is
        Assert.Equal(["drop, virtual time ...", "every strategy, virtual time ...", .. LateEventStrategies.Names.Select(name => $"  {name}")], tool.Error.Split(Environment.NewLine, StringSplitOptions.RemoveEmptyEntries));
    }

    [Fact]
    public void Out_OfADrop_HasPicturesNumbersAndAPageThatShowsThem()
    {
        using TemporaryFolder folder = new();
        Tool.Run("drop", "--time", "virtual", "--peers", "3", "--motion", "ballistic", "--out", folder["new/one"]).Done();
        string[] files = Directory.GetFiles(folder["new/one"]).Select(file => Path.GetFileName(file)!).Order(StringComparer.Ordinal).ToArray();
        Assert.Equal(
            ["drop-same-start.csv", "drop-same-start.svg", "drop-strategies.csv", "drop-strategies.svg", "drop-teleport.csv", "drop-teleport.svg", "report.html"],
            files);

        string[] lines = File.ReadAllText(folder["new/one/drop-teleport.csv"]).Split("\r\n", StringSplitOptions.RemoveEmptyEntries);
        Assert.Equal(
            "time_s,seen_height_0_m,seen_height_1_m,seen_height_2_m,settled_height_0_m,settled_height_1_m,settled_height_2_m,seen_error_m,seen_true_time_error_m,settled_error_m",
            lines[0]);
        Assert.Equal(3401, lines.Length);
        double[][] rows = lines.Skip(1).Select(line => line.Split(',').Select(field => double.Parse(field, NumberStyles.Float, CultureInfo.InvariantCulture)).ToArray()).ToArray();
        Assert.All(rows, row => Assert.True(row[4] == row[5] && row[5] == row[6] && row[9] == 0));
        Assert.Equal("strategy,time_s,seen_error_m,settled_error_m", File.ReadLines(folder["new/one/drop-strategies.csv"]).First());

        string page = File.ReadAllText(folder["new/one/report.html"]);
        Assert.Equal(4, page.Split("<svg").Length - 1);
        string[] words = ["seen", "true time", "settled", "stalled"];
        Assert.All(words, word => Assert.Contains($"<dt>{word}</dt>", page, StringComparison.Ordinal));
        Assert.Single(Regex.Matches(page, "class=\"finding\"")); // what came out, once and first
        Assert.Matches("<p class=\"finding\">After the event arrived, no bit differed between the peers in 3,3[0-9]{2} samples;", page);
        Assert.Contains("same-start", page, StringComparison.Ordinal);
        Assert.All(files.Where(file => file.EndsWith(".svg", StringComparison.Ordinal)), file => Assert.StartsWith("<svg", File.ReadAllText(folder[$"new/one/{file}"]), StringComparison.Ordinal));
    }

    [Fact]
    public void Report_OfADrop_HasOneTimeOriginAndTheMillisecondsOfTheEvent()
    {
        using TemporaryFolder folder = new();
        Tool.Run("drop", "--time", "virtual", "--motion", "ballistic", "--out", folder.Path).Done();
        string page = File.ReadAllText(folder["report.html"]);
        double[] lifts = [.. Regex.Matches(page, "lifted here: ([0-9.]+)")
            .Select(found => double.Parse(found.Groups[1].Value, CultureInfo.InvariantCulture))];
        Assert.Equal(2 + 1 + 5, lifts.Length); // a panel each of the case, of its milliseconds and of the strategies
        Assert.All(lifts, lift => Assert.Equal(lifts[0], lift, 1e-9));
        Assert.Contains(">From the lift until all know of it: 25 ms<", page, StringComparison.Ordinal);

        DropRun alone = Run("healing");
        Assert.Equal(
            DropChart.OfStrategies([alone], [alone]).Panels[0].Series[0].X, DropChart.OfStrategies([alone], []).Panels[0].Series[0].X);
    }

    [Fact]
    public void Finding_OfARun_SaysWhetherThePeersAgreeOnceTheEventIsThere()
    {
        string healing = DropFindings.Of(Run("healing")), none = DropFindings.Of(Run("none"));
        Assert.StartsWith("After the event arrived, no bit differed between the peers in ", healing, StringComparison.Ordinal);
        Assert.StartsWith("After the event arrived, the peers still differed in ", none, StringComparison.Ordinal); // the control
        DropOptions options = new() { IsVirtual = true, Cases = [DropCase.SameStart], Motion = MotionLaw.Ballistic };
        DropRun same = DropTest.Run(options).Single();
        Assert.Equal($"No bit differed between the peers in {same.Seen.Before.ToStatistics().Samples:N0} samples.", DropFindings.Of(same));
        Assert.Null(DropChart.OfEvent(same));
    }

    [Fact]
    public void Out_OfStrategiesThatGiveTheSameCurve_ShowsEachInAPanelOfItsOwn()
    {
        using TemporaryFolder folder = new();
        Tool.Run("drop", "--time", "virtual", "--case", "teleport", "--motion", "ballistic", "--out", folder.Path).Done();
        string chart = File.ReadAllText(folder["drop-strategies.svg"]);
        Assert.All(Enumerable.Range(0, 5), n => Assert.Equal(2, chart.Split($"class=\"line c{n}\"").Length - 1)); // the curve, and its place in the legend
        Assert.Equal(5, chart.Split(">between the peers, as seen<").Length - 1);
        Assert.Equal(5, chart.Split(">10\u2070<").Length - 1); // all of one scale
    }

    [Fact]
    public void Out_OfAnotherTestThanTheThesiss_DoesNotShowItsFigure()
    {
        using TemporaryFolder folder = new();
        Assert.Contains("thesis", Page(), StringComparison.Ordinal);
        Assert.DoesNotContain("thesis", Page("--second-height-m", "20"), StringComparison.Ordinal);

        string Page(params string[] more)
        {
            Tool.Run(["drop", "--time", "virtual", "--case", "teleport", "--motion", "ballistic", "--out", folder.Path, .. more]).Done();
            return File.ReadAllText(folder["report.html"]);
        }
    }

    [Fact]
    public void Numbers_InAnotherCulture_AreTheSame()
    {
        string[] call = ["drop", "--time", "virtual", "--motion", "ballistic", "--restitution", "0.75"];
        string[] expected = [Tool.Run(call).Done().Output, Tool.Run([.. call, "--json"]).Done().Output, Tool.Run([.. call, "--delay-ms", "x"]).Error];
        Assert.Equal(expected, WithComma(() => new[] { Tool.Run(call).Done().Output, Tool.Run([.. call, "--json"]).Done().Output, Tool.Run([.. call, "--delay-ms", "x"]).Error }));
        Assert.Contains(",5", WithComma(() => $"{1.5}"), StringComparison.Ordinal); // the control: it is another culture
    }

    [Fact]
    public void ExitCodeOf_PromiseKept_IsZero() => Assert.Equal(0, DropCommand.ExitCodeOf([Run("full-rollback"), Run("none"), Run("latency-forward")]));

    [Fact]
    public void ExitCodeOf_PromiseBroken_IsOne()
    {
        DropRun none = Run("none");
        DropRun broken = none with { Options = none.Options with { Strategy = "full-rollback" } };
        Assert.Equal(1, DropCommand.ExitCodeOf([broken]));
        Assert.Equal(1, DropCommand.ExitCodeOf([Run("full-rollback"), broken]));

        DropRun hash = Run("full-rollback");
        Assert.Equal(1, DropCommand.ExitCodeOf([hash with { StateHashes = [1, 2] }]));
    }

    [Fact]
    public void Transport_InRealTime_IsUdp() => Assert.Equal("udp", DropNames.Transport(new DropOptions()));

    [Fact]
    public void Transport_LiteNetLib_IsNamedInRealTimeOnly()
    {
        Assert.Equal("litenetlib", DropNames.Transport(new DropOptions { Carrier = CarrierChoice.Of("litenetlib") }));
        JsonElement run = Json("drop", "--time", "virtual", "--case", "same-start", "--transport", "litenetlib", "--json").GetProperty("runs")[0];
        Assert.Equal("virtual", Text(run, "transport"));
    }

    internal static T WithComma<T>(Func<T> work)
    {
        CultureInfo before = CultureInfo.CurrentCulture;
        CultureInfo comma = (CultureInfo)CultureInfo.InvariantCulture.Clone();
        comma.NumberFormat.NumberDecimalSeparator = ",";
        comma.NumberFormat.NumberGroupSeparator = ".";
        comma.NumberFormat.NegativeSign = "~";
        try
        {
            CultureInfo.CurrentCulture = comma;
            return work();
        }
        finally
        {
            CultureInfo.CurrentCulture = before;
        }
    }

    internal static JsonElement Json(params string[] arguments)
    {
        using JsonDocument document = JsonDocument.Parse(Tool.Run(arguments).Done().Output); // all of stdout is one document
        return document.RootElement.Clone();
    }

    internal static IEnumerable<string> Keys(JsonElement element) => element.EnumerateObject().Select(property => property.Name);

    internal static string Text(JsonElement element, string key) => element.GetProperty(key).GetString()!;

    private static long Differing(JsonElement run) => run.GetProperty("settled").GetProperty("after").GetProperty("differing_bits").GetInt64();

    private static DropRun Run(string strategy) => DropTest.Run(
        new DropOptions { IsVirtual = true, Cases = [DropCase.Teleport], Motion = MotionLaw.Ballistic, Strategy = strategy, Link = LinkProfiles.PureDelay(50) }).Single();
}
