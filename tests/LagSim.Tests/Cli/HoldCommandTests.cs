using System;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Hands;
using Xunit;

namespace LagSim.Tests.Cli;

public sealed class HoldCommandTests
{
    private static readonly string[] Keys =
    [
        "horizon_ms", "adaptive_m", "hold_last_m", "velocity_m", "best_in_hindsight_m", "best_in_hindsight", "linear_bound_m", "least_worst_m", "samples",
    ];

    [Fact]
    public void Json_OfAGeneratedMotion_HasTheKeysOfTheContractAndTheHarnesssFigures()
    {
        using JsonDocument document = JsonDocument.Parse(Tool.Run("hold", "--motion-input", "slow", "--json", "--seed", "7").Done().Output);
        JsonElement root = document.RootElement;
        Assert.Equal(
            ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "motion_input", "motion_s", "largest_acceleration_m_per_s2", "prediction_error_m"],
            root.EnumerateObject().Select(property => property.Name));
        JsonElement[] errors = root.GetProperty("prediction_error_m").EnumerateArray().ToArray();
        Assert.Equal(PredictionTest.DefaultHorizonsMilliseconds, errors.Select(error => error.GetProperty("horizon_ms").GetDouble()));
        Assert.All(errors, error => Assert.Equal(Keys, error.EnumerateObject().Select(property => property.Name)));
        PredictionError expected = PredictionTest.Run(HandMotions.Generate("slow", 7), 100);
        JsonElement at100 = errors.Single(error => error.GetProperty("horizon_ms").GetDouble() == 100);
        Assert.Equal(
            (expected.AdaptiveMetres, expected.HoldLastMetres, expected.VelocityMetres, expected.BestInHindsightMetres, expected.LinearMetres),
            (Number(at100, "adaptive_m"), Number(at100, "hold_last_m"), Number(at100, "velocity_m"), Number(at100, "best_in_hindsight_m"), Number(at100, "linear_bound_m")));
    }

    [Fact]
    public void Files_OfARecordedMotion_AreAPageTwoChartsAndATable()
    {
        using TemporaryFolder folder = new();
        string recorded = folder["hand.csv"];
        File.WriteAllText(recorded, HandMotionFile.Header + "\n" + string.Concat(Enumerable.Range(0, 240).Select(n => string.Create(
            CultureInfo.InvariantCulture, $"{n / 90.0},{Math.Sin(n / 20.0)},1,0\n"))));
        Tool tool = Tool.Run("hold", "--motion-input", recorded, "--out", folder["out"]).Done();
        Assert.Contains("adaptive", tool.Output, StringComparison.Ordinal);
        Assert.Equal(
            ["hold-motion.svg", "hold-prediction.csv", "hold-prediction.svg", "report.html"],
            Directory.EnumerateFiles(folder["out"]).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        string[] rows = File.ReadAllLines(Path.Combine(folder["out"], "hold-prediction.csv"));
        Assert.StartsWith("horizon_ms,adaptive_m,best_in_hindsight_m,linear_bound_m,least_worst_m,hold_m,damped_20_ms_m", rows[0], StringComparison.Ordinal);
        Assert.Equal(PredictionTest.DefaultHorizonsMilliseconds.Count + 1, rows.Length);
        Assert.Contains("best in hindsight", File.ReadAllText(Path.Combine(folder["out"], "report.html")), StringComparison.Ordinal);
    }

    [Fact]
    public void Refusals_NameTheValue()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["bad.csv"], HandMotionFile.Header + "\n0,0,0,0\n0.01,0,up,0\n");
        Tool.Refuses(3, ["hold", "--motion-input", folder["bad.csv"]], "bad.csv", "line 3", "y_m", "'up'");
        Tool.Refuses(3, ["hold", "--motion-input", "fast"], "'fast'", "slow, random");
        Tool.Refuses(3, ["hold", "--motion-input", ""], "''");
        Tool.Refuses(2, ["hold", "--seed", "x"], "--seed", "'x'");
    }

    private static double Number(JsonElement element, string key) => element.GetProperty(key).GetDouble();
}
