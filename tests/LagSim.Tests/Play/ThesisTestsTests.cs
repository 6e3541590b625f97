using System.Collections.Generic;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Hands;
using LagSim.Net.Strategies;
using LagSim.Play;
using Xunit;

namespace LagSim.Tests.Play;

/// <summary>The thesis's tests as the page runs them. That their figures are the tool's, the tests of the page in a browser say.</summary>
public sealed class ThesisTestsTests
{
    [Fact]
    public void RunDrop_ReportsBothHalvesAndEveryStrategy_WithTheWorstSampleOfEachColumn()
    {
        List<JsonElement> reports = [];
        List<double> progress = [];
        ThesisTests.RunDrop(3, report => reports.Add(JsonDocument.Parse(report).RootElement), progress.Add);

        Assert.Equal(
            ["same-start healing", "teleport healing", .. LateEventStrategies.Names.Select(name => $"teleport {name}")],
            reports.Select(report => $"{report.GetProperty("run").GetProperty("case")} {report.GetProperty("run").GetProperty("strategy")}"));
        foreach (JsonElement report in reports)
        {
            JsonElement[] points = [.. report.GetProperty("points").EnumerateArray()];
            Assert.InRange(points.Length, 300, 360);
            JsonElement seen = report.GetProperty("run").GetProperty("seen");
            double most = new[] { "before", "during", "after" }.Max(phase => seen.GetProperty(phase).GetProperty("max_m").GetDouble());
            Assert.Equal(most, points.Where(point => point[3].ValueKind == JsonValueKind.Number).Max(point => point[3].GetDouble()));
        }

        Assert.InRange(progress.Count, 50, 100);
        Assert.Equal(progress.Order(), progress);
        Assert.InRange(progress[^1], 0.95, 1.01);
    }

    [Fact]
    public void RunHold_ReportsEveryDelay_ThenThePredictionOfTheSameHand()
    {
        List<JsonElement> reports = [];
        List<double> progress = [];
        ThesisTests.RunHold(3, report => reports.Add(JsonDocument.Parse(report).RootElement), progress.Add);
        JsonElement[] runs = [.. reports.Take(7).Select(report => report.GetProperty("run"))];
        Assert.Equal([0, 25, 50, 100, 200, 300, 500], runs.Select(run => run.GetProperty("delay_ms").GetDouble()));
        Assert.All(runs, run => Assert.Equal(run.GetProperty("truth_state_hash").GetString(), run.GetProperty("state_hashes")[1].GetString()));
        HandMotion motion = HandMotions.Generate(HandMotions.Random, 3);
        Assert.Equal(
            PredictionTest.DefaultHorizonsMilliseconds.Select(horizon => (horizon, PredictionTest.Run(motion, horizon).AdaptiveMetres)),
            reports.Skip(7).Select(report => report.GetProperty("prediction")).Select(one => (one.GetProperty("horizon_ms").GetDouble(), one.GetProperty("adaptive_m").GetDouble())));
        Assert.Equal(progress.Order(), progress);
        Assert.InRange(progress[^1], 0.95, 1.01);
    }
}
