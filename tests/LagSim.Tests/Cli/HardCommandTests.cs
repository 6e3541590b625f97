using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Verification.Hard;
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
            ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "scale", "controls", "wall_s", "rows", "rows_passed", "cases", "stopped_early", "stopped_at"],
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
    public void Controls_SayPlainlyThatFailingIsRightAndNameWhichDidNot()
    {
        HardRow caught = new("case", "size", 2, "position_m", 1, "why", "what") { Note = "a wrong step" }, missed = caught with { Error = 0.5 };
        Assert.Contains("All 2 checks of wrong methods failed, as they must", Written(new([caught, caught], HardScale.Small, true, 1, 0.5)), StringComparison.Ordinal);
        string bad = Written(new([caught, missed], HardScale.Small, true, 1, 0.5));
        Assert.Contains("1 of 2 checks of wrong methods failed, as all of them must; NOT caught: 1, named below", bad, StringComparison.Ordinal);
        Assert.Contains("NOT CAUGHT: case, size (a wrong step): 0.5 is within 1, position (m)", bad, StringComparison.Ordinal);
        Assert.DoesNotContain("within their bound", bad, StringComparison.Ordinal);
    }

    [Fact]
    public void Rows_OfAllCases_AreALineEachWhereNoTerminalIs()
    {
        HardRow row = new("drag-quadratic", new string('x', 300) + " [y]", 1.234e-12, "position_at_the_worst_of_16_instants", 1.5e-11, "why", "what");
        string[] lines = Written(new([row, row with { Case = "rest", ErrorKind = "speed_m_per_s" }], HardScale.Small, false, 1, 0.5)).Split('\n');
        Assert.StartsWith("case            ", lines[2], StringComparison.Ordinal);
        Assert.StartsWith("drag-quadratic  1.234e-12  1.5e-11  passed   position at the worst of 16 instants: xxx", lines[3], StringComparison.Ordinal);
        Assert.StartsWith("rest            1.234e-12  1.5e-11  passed   speed (m/s): xxx", lines[4], StringComparison.Ordinal);
        Assert.EndsWith("x [y]", lines[4].TrimEnd(), StringComparison.Ordinal);
    }

    [Fact]
    public void Rows_OnATerminalOf80Columns_BreakTheLastTextAlone()
    {
        HardRow row = new("drag-quadratic", "so many words that no line of eighty columns has room for all of them", 1.234e-12, "time_s", 1.5e-11, "why", "what");
        string[] lines = Written(new([row], HardScale.Small, false, 1, 0.5), width: 80).Split('\n');
        Assert.All(lines.TakeWhile(line => !line.Contains("row within", StringComparison.Ordinal)), line => Assert.True(line.TrimEnd().Length <= 80, line));
        Assert.Contains(lines, line => line.Contains("drag-quadratic  1.234e-12  1.5e-11  passed ", StringComparison.Ordinal));
    }

    private static string Written(HardReport report, int? width = null)
    {
        using StringWriter output = new(), error = new();
        ToolConsole console = new(output, error, default);
        console.Rich.Profile.Width = width ?? console.Rich.Profile.Width;
        HardTables.Write(console, report, null);
        return output.ToString();
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
