using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary><c>lagsim explain</c>.</summary>
public sealed class ExplainCommandTests
{
    [Fact]
    public void Explain_BuiltIn_SaysWhatIsModelledAndWhatNot()
    {
        (int code, string output, string error) = Run("explain", "billiards");
        Assert.Equal((0, ""), (code, error));
        Assert.Contains("parabola", output, StringComparison.Ordinal);
        Assert.Contains("and 13 more", output, StringComparison.Ordinal);
        Assert.Matches("spin and friction +no", output);
    }

    [Fact]
    public void Explain_Json_HasEveryBodyAndFeature()
    {
        (int code, string output, _) = Run("explain", "billiards", "--json");
        Assert.Equal(0, code);
        using JsonDocument json = JsonDocument.Parse(output);
        Assert.Equal(16, json.RootElement.GetProperty("bodies").GetArrayLength());
        Assert.Equal("ballistic", json.RootElement.GetProperty("bodies")[3].GetProperty("motion").GetString());
        Assert.False(json.RootElement.GetProperty("features").EnumerateArray().First(f => f.GetProperty("name").GetString() == "integrator").GetProperty("modelled").GetBoolean());
    }

    [Fact]
    public void Explain_Rates_AreReadAsAPersonWritesThemAndExactInJson()
    {
        using TemporaryFolder folder = new();
        string scene = folder["air.json"];
        File.WriteAllText(scene, """
            {"format": "lagsim-scene-1", "name": "air", "forces": [{"name": "air", "kind": "linear_drag", "coefficient_kg_per_s": 0.1}],
             "bodies": [{"name": "b", "radius_m": 0.5, "mass_kg": 1, "restitution": 1, "position_m": [0, 0, 0], "forces": ["air"], "motion": "rk4", "step_s": 0.0558035714}]}
            """);
        Assert.Matches("rk4 +17.92 +89.6 ", Run("explain", scene).Output);
        using JsonDocument json = JsonDocument.Parse(Run("explain", scene, "--json").Output);
        Assert.InRange(json.RootElement.GetProperty("bodies")[0].GetProperty("force_evaluations_per_s").GetDouble(), 89.60000001, 89.6000001);
    }

    [Fact]
    public void Explain_SceneThatCannotBegin_IsExplained()
    {
        using TemporaryFolder folder = new();
        string scene = folder["storm.json"];
        File.WriteAllText(scene, """
            {"format": "lagsim-scene-1", "name": "storm", "forces": [{"name": "wind", "kind": "quadratic_drag", "coefficient_kg_per_m": 0.1, "medium_m_per_s": [1e12, 0, 0]}],
             "bodies": [{"name": "b", "radius_m": 0.5, "mass_kg": 1, "restitution": 1, "position_m": [0, 0, 0], "forces": ["wind"]}]}
            """);
        (int code, string output, string error) = Run("explain", scene);
        Assert.Equal((0, ""), (code, error));
        Assert.Matches("b +dp54 +- +- +Gravity, wind", output);
        Assert.Contains("No world of this scene can begin. At 0s", output, StringComparison.Ordinal);
        using JsonDocument json = JsonDocument.Parse(Run("explain", scene, "--json").Output);
        Assert.Equal(JsonValueKind.Null, json.RootElement.GetProperty("bodies")[0].GetProperty("segments_per_s").ValueKind);
        Assert.StartsWith("At 0s", json.RootElement.GetProperty("cannot_begin").GetString(), StringComparison.Ordinal);
        Assert.DoesNotContain("can begin", Run("explain", "billiards").Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Explain_LongNamesWithoutATerminal_KeepsTo160Columns()
    {
        using TemporaryFolder folder = new();
        string scene = folder["long.json"];
        string Name(int n) => $"{new string('b', 60)} {n}";
        string bodies = string.Join(",", Enumerable.Range(0, 5).Select(
            n => $$"""{"name": "{{Name(n)}}", "radius_m": 0.5, "mass_kg": 1, "restitution": 1, "position_m": [{{3 * n}}, 0, 0], "forces": ["f0"]}"""));
        string forces = string.Join(",", Enumerable.Range(0, 32).Select(n => $$"""{"name": "f{{n}}", "kind": "quadratic_drag", "coefficient_kg_per_m": 0.1}"""));
        File.WriteAllText(scene, $$"""{"format": "lagsim-scene-1", "name": "long", "forces": [{{forces}}], "bodies": [{{bodies}}]}""");
        string output = Run("explain", scene).Output;
        Assert.All(output.Split('\n'), line => Assert.True(line.TrimEnd().Length <= 160, line));
        Assert.Contains($"{Name(0)} and 4 more", output, StringComparison.Ordinal);
        Assert.DoesNotContain(Name(1), output, StringComparison.Ordinal);
    }

    [Fact]
    public void Explain_NoScene_IsAnError() => Assert.Equal(3, Run("explain", "nowhere.json").Code);

    private static (int Code, string Output, string Error) Run(params string[] arguments)
    {
        using StringWriter output = new(), error = new();
        int code = Program.Run(arguments, output, error, default);
        return (code, output.ToString(), error.ToString());
    }
}
