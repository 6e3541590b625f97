using System;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli.Commands;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using Xunit;

namespace LagSim.Tests.Cli;

public sealed class HoldCommandTests
{
    private static readonly string[] Keys =
    [
        "horizon_ms", "adaptive_m", "hold_last_m", "velocity_m", "best_in_hindsight_m", "best_in_hindsight", "linear_bound_m", "least_worst_m", "samples",
    ];

    private static readonly string[] RunKeys =
    [
        "case", "strategy", "motion", "time", "transport", "profile", "delay_ms", "peers", "seen", "seen_true_time", "settled", "state_hashes", "event_hashes",
        "clock_error_ms", "events", "heals", "bytes_sent_per_s", "event_lateness_ms", "cpu_cores_at_rest", "truth_state_hash", "truth_event_hash", "hold_s", "knot_distance_m", "knots",
        "knots_per_s", "holder_bytes_sent_per_s", "holder_bytes_received_per_s", "holder_error", "held_error",
    ];

    [Fact]
    public void Json_OfAGeneratedMotion_HasTheKeysOfTheContractAndTheHarnesssFigures()
    {
        using JsonDocument document = JsonDocument.Parse(
            Tool.Run("hold", "--motion-input", "slow", "--delay-ms", "100", "--hold-s", "2", "--json", "--seed", "7").Done().Output);
        JsonElement root = document.RootElement;
        Assert.Equal(
            [
                "tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "motion_input", "motion_s", "largest_acceleration_m_per_s2", "runs",
                "prediction_error_m",
            ],
            Names(root));
        JsonElement run = Assert.Single(root.GetProperty("runs").EnumerateArray());
        Assert.Equal(RunKeys, Names(run));
        Assert.Equal(("hold", "healing", "rk4", "virtual", "virtual"), (Text(run, "case"), Text(run, "strategy"), Text(run, "motion"), Text(run, "time"), Text(run, "transport")));
        Assert.Equal((JsonValueKind.Null, 100), (run.GetProperty("profile").ValueKind, Number(run, "delay_ms")));
        Assert.All(run.GetProperty("settled").EnumerateObject(), phase => Assert.Equal(0, phase.Value.GetProperty("differing_bits").GetInt64()));
        Assert.All(run.GetProperty("state_hashes").EnumerateArray(), hash => Assert.Equal(Text(run, "truth_state_hash"), hash.GetString()));
        JsonElement held = Assert.Single(run.GetProperty("held_error").EnumerateArray());
        Assert.Equal(["peer", "simulated", "predicted", "hold_last_m", "velocity_m", "best_in_hindsight_m", "best_in_hindsight"], Names(held));
        HoldRun played = HoldTest.Run(new HoldOptions(HandMotions.Generate("slow", 7)) { HoldSeconds = 2, Seed = 7 });
        Assert.Equal(
            (played.Views[0].Simulated.RmsMetres, played.Views[0].Predicted.RmsMetres, played.KeyframesPerSecond, played.HolderSentPerSecond),
            (Number(held.GetProperty("simulated"), "rms_m"), Number(held.GetProperty("predicted"), "rms_m"), Number(run, "knots_per_s"), Number(run, "holder_bytes_sent_per_s")));
        JsonElement[] errors = root.GetProperty("prediction_error_m").EnumerateArray().ToArray();
        Assert.Equal(PredictionTest.DefaultHorizonsMilliseconds, errors.Select(error => error.GetProperty("horizon_ms").GetDouble()));
        Assert.All(errors, error => Assert.Equal(Keys, Names(error)));
        PredictionError expected = PredictionTest.Run(HandMotions.Generate("slow", 7), 100);
        JsonElement at100 = errors.Single(error => error.GetProperty("horizon_ms").GetDouble() == 100);
        Assert.Equal(
            (expected.AdaptiveMetres, expected.HoldLastMetres, expected.VelocityMetres, expected.BestInHindsightMetres, expected.LinearMetres),
            (Number(at100, "adaptive_m"), Number(at100, "hold_last_m"), Number(at100, "velocity_m"), Number(at100, "best_in_hindsight_m"), Number(at100, "linear_bound_m")));
    }

    [Fact]
    public void Files_OfARecordedMotionAtEveryDelay_AreAPageChartsAndTables()
    {
        using TemporaryFolder folder = new();
        string recorded = Recorded(folder);
        Tool tool = Tool.Run("hold", "--motion-input", recorded, "--out", folder["out"]).Done();
        Assert.Contains("predicted", tool.Output, StringComparison.Ordinal);
        Assert.Contains("0 of 2033", tool.Output, StringComparison.Ordinal); // settled, of 10.167 s at 200 a second
        string[] links = ["delay-0ms", "delay-100ms", "delay-200ms", "delay-25ms", "delay-300ms", "delay-500ms", "delay-50ms"];
        Assert.All(links, link => Assert.Contains(link, tool.Output, StringComparison.Ordinal));
        Assert.Equal(
            [
                .. links.SelectMany(link => new[] { $"hold-{link}-throw.svg", $"hold-{link}.csv", $"hold-{link}.svg" }), "hold-delays.svg", "hold-motion.svg", "hold-prediction.csv",
                "hold-prediction.svg", "hold-views.svg", "hold.csv", "report.html",
            ],
            Directory.EnumerateFiles(folder["out"]).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        string[] rows = File.ReadAllLines(Path.Combine(folder["out"], "hold-prediction.csv"));
        Assert.StartsWith("horizon_ms,adaptive_m,best_in_hindsight_m,linear_bound_m,least_worst_m,hold_m,damped_20_ms_m", rows[0], StringComparison.Ordinal);
        Assert.Equal(PredictionTest.DefaultHorizonsMilliseconds.Count + 1, rows.Length);
        Assert.Equal(8, File.ReadAllLines(Path.Combine(folder["out"], "hold.csv")).Length);
        Assert.StartsWith("time_s,hand_x_m,hand_y_m,hand_z_m,seen_0_x_m,", File.ReadLines(Path.Combine(folder["out"], "hold-delay-25ms.csv")).First(), StringComparison.Ordinal);
        string page = File.ReadAllText(Path.Combine(folder["out"], "report.html"));
        Assert.All(new[] { "best in hindsight", "thrown here", "as predicted", "The held ball by delay" }, words => Assert.Contains(words, page, StringComparison.Ordinal));
        Assert.Contains("thesis's own figures", page, StringComparison.Ordinal);
        Assert.Contains("Once every event had arrived, no bit differed between the peers at any delay.", page, StringComparison.Ordinal);
    }

    [Fact]
    public void Json_OfAProfileAndAStrategyThatPromisesNothing_IsDoneAndDiffers()
    {
        using TemporaryFolder folder = new();
        string[] call = ["hold", "--motion-input", Recorded(folder), "--profile", "awful", "--peers", "3", "--hold-s", "1.5", "--json"];
        using JsonDocument healed = JsonDocument.Parse(Tool.Run(call).Done().Output), left = JsonDocument.Parse(Tool.Run([.. call, "--strategy", "none"]).Done().Output);
        JsonElement healing = healed.RootElement.GetProperty("runs")[0], none = left.RootElement.GetProperty("runs")[0];
        Assert.Equal(("awful", JsonValueKind.Null, 3), (Text(healing, "profile"), healing.GetProperty("delay_ms").ValueKind, healing.GetProperty("peers").GetInt32()));
        Assert.Equal([0, 2], healing.GetProperty("held_error").EnumerateArray().Select(view => view.GetProperty("peer").GetInt32()));
        Assert.Equal(0, healing.GetProperty("settled").GetProperty("after").GetProperty("differing_bits").GetInt64());
        Assert.True(none.GetProperty("settled").GetProperty("after").GetProperty("differing_bits").GetInt64() > 100);
        Assert.Equal(1.5, Number(healing, "hold_s"));
    }

    [Fact]
    public void ExitCode_OfARunThatPromisedAgreementAndDidNotAgree_IsOne()
    {
        HoldRun run = HoldTest.Run(new HoldOptions(HandMotions.Generate("slow", 1)) { HoldSeconds = 1 });
        HoldRun broken = run with { EventHashes = [run.EventHashes[0], run.EventHashes[0] ^ 1] };
        Assert.Equal(0, HoldCommand.ExitCodeOf([run]));
        Assert.Equal(1, HoldCommand.ExitCodeOf([run, broken]));
        Assert.Equal(0, HoldCommand.ExitCodeOf([broken with { Options = run.Options with { Strategy = "none" } }]));
    }

    [Fact]
    public void Refusals_NameTheValue()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["bad.csv"], HandMotionFile.Header + "\n0,0,0,0\n0.01,0,up,0\n");
        File.WriteAllText(folder["fast.csv"], Motion(n => 2 * (n % 2)));
        Tool.Refuses(3, ["hold", "--motion-input", folder["bad.csv"]], "bad.csv", "line 3", "y_m", "'up'");
        Tool.Refuses(3, ["hold", "--motion-input", folder["fast.csv"]], "fast.csv", "m/s", "up to 100 m/s");
        Tool.Refuses(3, ["hold", "--motion-input", folder.Path], folder.Path);
        Tool.Refuses(3, ["hold", "--motion-input", "fast"], "'fast'", "slow, random");
        Tool.Refuses(3, ["hold", "--motion-input", ""], "''");
        Tool.Refuses(2, ["hold", "--seed", "x"], "--seed", "'x'");
        Tool.Refuses(2, ["hold", "--delay-ms", "20", "--profile", "awful"], "--delay-ms and --profile exclude each other");
        Tool.Refuses(2, ["hold", "--profile", "moon"], "'moon'", "awful", "delay-Nms");
        Tool.Refuses(2, ["hold", "--delay-ms", "-1"], "--delay-ms is '-1'", "between 0 and 2000");
        Tool.Refuses(2, ["hold", "--delay-ms", "NaN"], "--delay-ms is 'NaN'", "between 0 and 2000");
        Tool.Refuses(2, ["hold", "--time", "slow"], "--time is 'slow'", "real, virtual");
        Tool.Refuses(2, ["hold", "--strategy", "hope"], "--strategy is 'hope'", "healing");
        Tool.Refuses(2, ["hold", "--peers", "1"], "--peers is '1'", "between 2 and 9");
        Tool.Refuses(2, ["hold", "--hold-s", "51"], "--hold-s is '51'", "between 1 and 50");
        Tool.Refuses(2, ["hold", "--hold-s", "20", "--motion-input", Recorded(folder)], "--hold-s is 20", "hand.csv", "2.667 s");
        Tool.Refuses(2, ["hold", "--knot-distance-m", "0"], "--knot-distance-m is '0'", "between 1E-06 and 1");
    }

    private static string Recorded(TemporaryFolder folder)
    {
        File.WriteAllText(folder["hand.csv"], Motion(n => Math.Sin(n / 20.0)));
        return folder["hand.csv"];
    }

    private static string Motion(Func<int, double> x) => HandMotionFile.Header + "\n" + string.Concat(Enumerable.Range(0, 241).Select(n => string.Create(
        CultureInfo.InvariantCulture, $"{n / 90.0},{x(n)},1,0\n")));

    [Theory]
    [InlineData("2000", JsonValueKind.Null)] // longer than the motion: no keyframe comes while it lasts
    [InlineData("100", JsonValueKind.Number)]
    public void Json_OfWhatNoSampleWasMeasuredOf_IsNull(string delay, JsonValueKind kind)
    {
        using JsonDocument document = JsonDocument.Parse(
            Tool.Run("hold", "--motion-input", "slow", "--hold-s", "1", "--delay-ms", delay, "--json").Done().Output);
        JsonElement held = document.RootElement.GetProperty("runs")[0].GetProperty("held_error")[0];
        Assert.Equal(kind == JsonValueKind.Null, held.GetProperty("predicted").GetProperty("samples").GetInt64() == 0);
        Assert.Equal(
            [kind, kind, kind, kind, kind],
            new[] { held.GetProperty("predicted").GetProperty("rms_m"), held.GetProperty("predicted").GetProperty("max_m"), held.GetProperty("hold_last_m"), held.GetProperty("velocity_m"), held.GetProperty("best_in_hindsight_m") }
                .Select(figure => figure.ValueKind));
        Assert.Equal(kind == JsonValueKind.Null, held.GetProperty("best_in_hindsight").ValueKind == JsonValueKind.Null);
    }

    private static string[] Names(JsonElement element) => element.EnumerateObject().Select(property => property.Name).ToArray();

    private static string? Text(JsonElement element, string key) => element.GetProperty(key).GetString();

    private static double Number(JsonElement element, string key) => element.GetProperty(key).GetDouble();
}
