using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Xml.Linq;
using LagSim.Harness.Experiments.Accuracy;
using Xunit;

namespace LagSim.Tests.Cli;

[Trait("Time", "real")]
public sealed class AccuracyCommandTests
{
    private const string Overlap = "deepest_overlap_m";

    [Fact]
    public void Json_OfAScene_HasTheKeysOfTheContract()
    {
        using JsonDocument document = JsonDocument.Parse(Tool.Run("accuracy", "spring", "--quick", "--peers", "mathnet", "--json").Done().Output);
        JsonElement root = document.RootElement;
        Assert.Equal(
            ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "quick", "clock", "points", "orders", "spread",
                "findings", "left_out", "caution", "stopped_early", "stopped_at"],
            root.EnumerateObject().Select(p => p.Name));
        JsonElement[] points = [.. root.GetProperty("points").EnumerateArray()];
        Assert.Equal(15, points.Length); // three settings of five methods
        Assert.All(points, point => Assert.Equal(
            ["scene", "method", "setting", "step_s", "error", "error_kind", "cpu_s", "runs", "simulated_s", "events"], point.EnumerateObject()
                .Select(p => p.Name)));
        Assert.Equal("spring", root.GetProperty("scene").GetString());
        Assert.Equal(16, root.GetProperty("scene_hash").GetString()!.Length);
        Assert.Equal(0, root.GetProperty("spread").GetArrayLength());
        Assert.Equal(3, root.GetProperty("orders").EnumerateObject().Count());
        Assert.All(root.GetProperty("orders").EnumerateObject(), order =>
            Assert.InRange(order.Value.GetDouble() - (order.Name.Contains("DormandPrince54", StringComparison.Ordinal) ? 5 : 4), -0.5, 0.5));
        Assert.Equal(WorkFindings.Caution, root.GetProperty("caution").GetString());
    }

    [Fact]
    public void Files_AreATableTwoChartsASceneAndAPageThatNeverShowsThemWithoutTheCaution()
    {
        using TemporaryFolder folder = new();
        Tool tool = Tool.Run("accuracy", "drag", "--quick", "--peers", "none", "--out", folder["out"]).Done();
        Assert.Contains(WorkFindings.Caution, tool.Output, StringComparison.Ordinal);
        Assert.Equal(
            ["accuracy-drag-steps.svg", "accuracy-drag-work.svg", "accuracy.csv", "report.html"],
            Directory.EnumerateFiles(folder["out"]).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        string[] rows = File.ReadAllLines(folder["out/accuracy.csv"]);
        Assert.Equal("scene,method,setting,error,error_kind,cpu_s,simulated_s,events", rows[0]);
        Assert.Equal(13, rows.Length);
        Assert.Contains("other shapes, joints and many threads", File.ReadAllText(folder["out/report.html"]), StringComparison.Ordinal);
        string steps = XElement.Load(folder["out/accuracy-drag-steps.svg"]).Value;
        Assert.Contains("order 4", steps, StringComparison.Ordinal);
        Assert.Contains("order 5", steps, StringComparison.Ordinal);
    }

    [Fact]
    public void Json_OfHeapsThatAreDrawn_HasEachAndTheirSpread()
    {
        Tool tool = Tool.Run("accuracy", "heaps", "--quick", "--peers", "none", "--seed", "5", "--json").Done();
        using JsonDocument document = JsonDocument.Parse(tool.Output);
        JsonElement[] points = [.. document.RootElement.GetProperty("points").EnumerateArray()];
        Assert.Equal(Enumerable.Range(1, 8).Select(n => $"heaps-{n}"), points.Select(point => Word(point, "scene")).Distinct());
        JsonElement first = document.RootElement.GetProperty("spread")[0];
        Assert.Equal(
            ["method", "setting", "error_kind", "scenes", "error", "simulated_s_per_cpu_s"], first.EnumerateObject().Select(p => p.Name));
        Assert.Equal(("d=0.1", Overlap, 8), (Word(first, "setting"), Word(first, "error_kind"), first.GetProperty("scenes").GetInt32()));
        double[] errors = [.. points.Where(point => Word(point, "setting") == "d=0.1" && Word(point, "error_kind") == Overlap)
            .Select(point => point.GetProperty("error").GetDouble()).Order()];
        Assert.Equal(
            [errors[0], (errors[3] + errors[4]) / 2, errors[7]],
            first.GetProperty("error").EnumerateObject().Select(p => p.Value.GetDouble()));

        static string? Word(JsonElement of, string key) => of.GetProperty(key).GetString();
    }

    [Fact]
    public void Json_OfAPeerWhoseLibraryPrints_IsAllThereIsOnStdout()
    {
        using ToolProcess tool = ToolProcess.Start("accuracy drop --quick --peers chipmunk --json");
        bool isThere = WorkMethods.All.Single(method => method.Engine == "chipmunk").Missing is null;
        tool.Ends(isThere ? 0 : 3);
        using JsonDocument document = JsonDocument.Parse(tool.Output.ToString());
        if (!isThere)
        {
            Assert.Contains("apt-get install libchipmunk7", document.RootElement.GetProperty("error").GetString(), StringComparison.Ordinal);
            return;
        }

        Assert.Contains(document.RootElement.GetProperty("points").EnumerateArray(), point => point.GetProperty("method").GetString() == "Chipmunk");
    }

#if !WITH_PEERS
    [Fact]
    public void Peer_ThatAloneIsAskedForAndIsMissing_IsAnErrorAndAmongAllIsLeftOut()
    {
        const string why = "it is not in this build; -p:WithPeers=true builds it in and needs the package Box2D.NET.";
        Tool.Refuses(3, ["accuracy", "drop", "--peers", "box2d"], $"--peers is 'box2d', which is missing here: {why}");
        Tool.Refuses(3, ["accuracy", "drop", "--peers", "box2d", "--json"], why);
        Assert.Contains($"Box2D.NET is left out: {why}", Tool.Run("accuracy", "spring", "--quick").Done().Output, StringComparison.Ordinal);
    }
#endif

    [Fact]
    public void Peer_ThatSuitsNoneOfTheScenes_IsRefused()
    {
        Tool.Refuses(2, ["accuracy", "billiards", "--peers", "mathnet"], "--peers is 'mathnet', which is left out of billiards: it is an integrator");
    }

    [Fact]
    public void Refusals_NameTheValueAndWhatThereIs()
    {
        Tool.Refuses(2, ["accuracy", "stack"], "'stack'", "all or one of drop, elastic49");
        Tool.Refuses(2, ["accuracy", "--peers", "havok"], "'havok'", "all, none, mathnet, ode, chipmunk, jitter, bepu, box2d");
        Tool.Refuses(2, ["accuracy", "--quick", "--longest-s", "3"], "--quick and --longest-s exclude each other");
        Tool.Refuses(2, ["accuracy", "--longest-s", "0"], "'0'", "--longest-s");
    }
}
