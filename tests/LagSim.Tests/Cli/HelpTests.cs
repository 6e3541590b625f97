using System;
using System.CommandLine;
using System.CommandLine.Help;
using System.IO;
using System.Linq;
using LagSim.Cli;
using LagSim.Cli.Output;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The help of the tool and of each of its commands.</summary>
public sealed class HelpTests
{
    public static TheoryData<string> Commands => [.. Root(TextWriter.Null).Subcommands.Select(command => command.Name)];

    [Fact]
    public void Call_WithoutACommand_PrintsTheHelpAndIsDone()
    {
        Tool tool = Tool.Run().Done();
        Assert.Equal("", tool.Error);
        Assert.Equal(Tool.Run("--help").Done().Output, tool.Output);
        string[] lines = [.. tool.Output.ReplaceLineEndings("\n").Split('\n')];
        Assert.All(
            Commands.Select(row => row.Data),
            name => Assert.Contains(lines, line => line.StartsWith($"  {name} ", StringComparison.Ordinal)));
    }

    [Fact]
    public void Help_OfTheTool_FitsAndHasOneSentenceForEachCommand()
    {
        Tool tool = Tool.Run("--help").Done();
        Assert.Empty(TooLong(tool.Output));
        Assert.Contains("Joins a session; the scene comes from the host.", tool.Output, StringComparison.Ordinal);
        Assert.DoesNotContain("Exits with", tool.Output, StringComparison.Ordinal);
    }

    [Theory]
    [MemberData(nameof(Commands))]
    public void Help_OfACommand_FitsAndGoesToStdout(string command)
    {
        Tool tool = Tool.Run(command, "--help").Done();
        Assert.Equal("", tool.Error);
        Assert.Contains($"lagsim {command}", tool.Output, StringComparison.Ordinal);
        Assert.Empty(TooLong(tool.Output));
    }

    [Theory]
    [MemberData(nameof(Commands))]
    public void Help_ThatIsNotWrapped_IsFoundToBeTooLong(string command) // the control
    {
        using StringWriter output = new();
        Command root = Root(output);
        root.Options.OfType<HelpOption>().Single().Action = new HelpAction { MaxWidth = int.MaxValue };
        root.Parse([command, "--help"]).Invoke(new InvocationConfiguration { Output = output });
        Assert.NotEmpty(TooLong(output.ToString()));
    }

    private static Command Root(TextWriter output) =>
        Program.Root(new ToolConsole(output, TextWriter.Null, TestContext.Current.CancellationToken));

    private static string[] TooLong(string help) =>
        [.. help.ReplaceLineEndings("\n").Split('\n').Where(line => line.Length > HelpOfTool.MaxColumns)];
}
