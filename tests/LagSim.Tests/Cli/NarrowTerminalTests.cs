using System;
using System.IO;
using System.Linq;
using LagSim.Cli.Output;
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
