using System;
using System.IO;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Harness.Reports;
using Spectre.Console;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>Tables on a terminal that has no room for them.</summary>
public sealed class NarrowTerminalTests
{
    private const string Long = "max_position_error_m";

    [Theory]
    [InlineData(40)]
    [InlineData(60)]
    [InlineData(79)]
    public void Table_WiderThanTheTerminal_IsAListInWhichNothingIsBroken(int width)
    {
        string[] lines = Written(width, columns: 8);
        Assert.All(lines, line => Assert.True(line.TrimEnd().Length <= width, $"'{line}'"));
        Assert.Equal(16, lines.Count(line => line.Contains(Long, StringComparison.Ordinal) && line.Contains("1.23e-15", StringComparison.Ordinal)));
    }

    [Theory]
    [InlineData(79, 2)] // there is room
    [InlineData(80, 8)] // as wide as usual
    public void Table_Else_IsATable(int width, int columns)
    {
        string[] lines = Written(width, columns);
        Assert.DoesNotContain(lines, line => line.Contains(Long, StringComparison.Ordinal) && line.Contains("1.23e-15", StringComparison.Ordinal));
        Assert.Contains(lines, line => line.Split("1.23e-15").Length == columns + 1);
    }

    [Theory]
    [InlineData("gas", "LagSim RungeKutta4")]
    [InlineData("kepler", "LagSim DormandPrince54, fixed steps")]
    public void Accuracy_InAWindowOf80Columns_HasAllNumbersOfARowOnALine(string scene, string method)
    {
        Assert.True(WorkScenes.TryGet(scene, out WorkScene? found));
        WorkPoint[] points = [.. new[] { "1/10000 s", "no step" }.SelectMany(setting => found.ErrorKinds.Select((kind, n) => new WorkPoint(
            scene, method, setting, 1e-4, ErrorOf(kind, n), kind, 2.3456e-5, 1, 1.2345, 1_234_567)))];
        using StringWriter output = new(), error = new();
        ToolConsole console = new(output, error, TestContext.Current.CancellationToken);
        console.Rich.Profile.Width = 80;
        AccuracyTables.Write(console, new AccuracyReport([found], new WorkReport(points, [], []), false, 1), null);
        string[] lines = [.. output.ToString().Split('\n').TakeWhile(line => !line.StartsWith("Speed is", StringComparison.Ordinal))];
        Assert.All(lines, line => Assert.True(line.TrimEnd().Length <= 80, line));
        string[] numbers = [.. found.ErrorKinds.Select((kind, n) => NumberText.Short(ErrorOf(kind, n))), NumberText.Short(1.2345 / 2.3456e-5)];
        Assert.Equal(2, lines.Count(line => numbers.All(number => line.Contains($" {number} ", StringComparison.Ordinal))));
        Assert.Single(lines, line => line.Contains("LagSim", StringComparison.Ordinal)); // named once

        static double ErrorOf(string kind, int n) => kind.Contains("pairs", StringComparison.Ordinal) ? 123 : (n + 1.23456) * 1e-15;
    }

    [Theory]
    [InlineData(80, 3)]
    [InlineData(120, 2)]
    [InlineData(200, 1)]
    public void Sweep_InAWindow_HasEveryHeadingWholeInAsManyTablesAsItTakes(int width, int tables)
    {
        SweepOutcome[] outcomes = [.. new[] { 3, 8 }.Select(clients => new SweepOutcome
        {
            Cell = new SweepCell(clients, 40, 10_000_000, 2000, true), LoadShare = 16.15, OfferedBytesPerSecond = 13_367, DeliveredBytesPerSecond = 13_366,
            SentBytesPerSecond = 49_554, IdleRoundTripMs = 40, RoundTripP50Ms = 1_306, RoundTripP99Ms = 5_285, Done = 11_220, Refused = 10_966, ComparedShare = 1,
        })];
        using StringWriter output = new(), error = new();
        ToolConsole console = new(output, error, TestContext.Current.CancellationToken);
        console.Rich.Profile.Width = width;
        SweepTables.Write(console, outcomes, null, outcomes.Length);
        string[] lines = [.. output.ToString().Split('\n').TakeWhile(line => !line.StartsWith("Offered", StringComparison.Ordinal))];
        Assert.All(lines, line => Assert.True(line.TrimEnd().Length <= width, line));
        string[] words = string.Join(' ', lines).Split(' ', StringSplitOptions.RemoveEmptyEntries);
        Assert.All(SweepTables.Headings.SelectMany(heading => heading.Split(' ')), word => Assert.Contains(word, words));
        Assert.Equal(tables, words.Count(word => word == "clients"));
        Assert.Equal(2 * tables, lines.Count(line => line.Contains(" 10000 ", StringComparison.Ordinal)));
    }

    private static string[] Written(int width, int columns)
    {
        using StringWriter output = new(), error = new();
        ToolConsole console = new(output, error, TestContext.Current.CancellationToken);
        console.Rich.Profile.Width = width;
        Table table = DropTables.NewTable("a title", [.. Enumerable.Repeat(Long, columns)]);
        table.AddRow([.. Enumerable.Repeat("1.23e-15", columns)]);
        table.AddRow([.. Enumerable.Repeat("1.23e-15", columns)]);
        console.Write(table);
        return output.ToString().Split('\n');
    }
}
