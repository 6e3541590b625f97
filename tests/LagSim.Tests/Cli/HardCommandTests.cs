using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Hard;
using Xunit;

namespace LagSim.Tests.Cli;

public sealed class HardCommandTests
{
    [Fact]
    public void Json_OfACase_HasTheKeysOfTheContractAndTheHarnesssFigures()
    {
        using JsonDocument document = JsonDocument.Parse(Tool.Run("hard", "mass-chain", "--scale", "small", "--json").Done().Output);
        JsonElement root = document.RootElement;
        Assert.Equal(
            ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "scale", "controls", "wall_s", "rows", "rows_passed", "cases"],
            root.EnumerateObject().Select(p => p.Name));
        JsonElement[] cases = [.. root.GetProperty("cases").EnumerateArray()];
        Assert.All(cases, c => Assert.Equal(
            ["case", "size", "error", "error_kind", "bound", "passed", "modelled", "reference", "argument", "note"], c.EnumerateObject().Select(p => p.Name)));
        Assert.True(HardCases.TryGet("mass-chain", out IHardCase? found));
        HardRow[] rows = [.. HardCases.Run([found], HardScale.Small, 1, cancellation: TestContext.Current.CancellationToken)];
        Assert.Equal(rows.Select(row => row.Error), cases.Select(c => c.GetProperty("error").GetDouble()));
        Assert.All(cases, c => Assert.True(c.GetProperty("passed").GetBoolean()));
    }

    [Fact]
    public void ABoundThatIsExceeded_IsShownAsFailedAndTheExitCodeIsOne()
    {
        // Nothing fails now: a row that passed, and the same with an error beyond its bound.
        Assert.True(HardCases.TryGet("mass-chain", out IHardCase? found));
        HardRow passed = HardCases.Run([found], HardScale.Small, 1, cancellation: TestContext.Current.CancellationToken)[0];
        HardReport good = new([passed], HardScale.Small, false, 1, 0.5), bad = new([passed, passed with { Error = 2 * passed.Bound }], HardScale.Small, false, 1, 0.5);
        Assert.Equal((0, 1), (HardCommand.ExitCodeOf(good), HardCommand.ExitCodeOf(bad)));
        using StringWriter output = new(), error = new();
        HardTables.Write(new ToolConsole(output, error, default), bad, null);
        Assert.Contains($"FAILED: {passed.Case}, {passed.Size}", output.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Controls_AllFailAndThatIsRight()
    {
        Tool tool = Tool.Run("hard", "graze", "--scale", "small", "--controls").Done();
        Assert.Contains("each must fail", tool.Output, StringComparison.Ordinal);
        Assert.DoesNotContain("passed", tool.Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Files_AreATableAndAPageWithTheArguments()
    {
        using TemporaryFolder folder = new();
        Tool.Run("hard", "oscillator", "--scale", "small", "--out", folder["out"]).Done();
        Assert.Equal(["hard.csv", "report.html"], Directory.EnumerateFiles(folder["out"]).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        Assert.StartsWith("case,size,error,error_kind,bound,passed,modelled,reference,argument,note", File.ReadLines(folder["out/hard.csv"]).First(),
            StringComparison.Ordinal);
        Assert.Contains("quintic", File.ReadAllText(folder["out/report.html"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Refusals_NameTheValueAndWhatThereIs()
    {
        Tool.Refuses(2, ["hard", "zeno"], "'zeno'", "all or one of drop, elastic-bounce");
        Tool.Refuses(2, ["hard", "--scale", "huge"], "'huge'", "full, small");
    }
}
