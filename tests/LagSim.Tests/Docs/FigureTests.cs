using System.Globalization;
using System.Linq;
using System.Text.Json;
using Xunit;
using static LagSim.Tests.Cli.DropCommandTests;

namespace LagSim.Tests.Docs;

/// <summary>Figures of the documents that are the same bits on every machine are those that the tool gives now: of virtual time, not of clocks.</summary>
public sealed class FigureTests
{
    [Fact]
    public void Readme_TableOfStrategies_IsWhatCompareGives()
    {
        string readme = SnippetTests.Read("README.md");
        JsonElement[] runs = Json("compare", "--scene", "billiards", "--profile", "transatlantic", "--json").GetProperty("runs").EnumerateArray().ToArray();
        Assert.Equal(5, runs.Length);
        foreach (JsonElement run in runs)
        {
            JsonElement seen = run.GetProperty("seen");
            string[] cells =
            [
                $"`{run.GetProperty("strategy").GetString()}`",
                Metres(seen.GetProperty("during").GetProperty("max_m")), Metres(seen.GetProperty("after").GetProperty("max_m")),
                Metres(run.GetProperty("seen_from_truth").GetProperty("after").GetProperty("max_m")), Metres(run.GetProperty("corrections_seen_m").GetProperty("max")),
                run.GetProperty("events_rerun").GetProperty("mean").GetDouble().ToString("F1", CultureInfo.InvariantCulture),
                run.GetProperty("cone_bodies").GetProperty("mean").GetDouble().ToString("F0", CultureInfo.InvariantCulture),
            ];
            Assert.Contains($"| {string.Join(" | ", cells)} |", readme, System.StringComparison.Ordinal);
        }
    }

    private static string Metres(JsonElement figure) => figure.GetDouble() == 0 ? "0" : figure.GetDouble().ToString("F2", CultureInfo.InvariantCulture);
}
