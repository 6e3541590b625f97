using System;
using System.CommandLine;
using System.CommandLine.Help;
using System.CommandLine.Parsing;
using System.IO;
using System.Linq;
using System.Text;
using System.Threading;
using LagSim.Cli.Commands;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;

namespace LagSim.Cli;

/// <summary>
/// The entry point of the tool: parses the command line, runs one command, and maps failures to a message and an exit code.
/// </summary>
internal static class Program
{
    internal static int Main(string[] arguments)
    {
        // Not every code page has the characters of tables and curves.
        Console.OutputEncoding = new UTF8Encoding(encoderShouldEmitUTF8Identifier: false);
        using Interruption interruption = new();
        int code;
        try
        {
            code = Run(arguments, StandardOutput.Open(), Console.Error, interruption.Token, () => interruption.ExitCode);
        }
        catch (IOException)
        {
            code = ExitCode.Input; // not even the failure can be told, as on a terminal that is closed
        }

        return code == ExitCode.CheckFailed ? code : interruption.ExitCode ?? code; // a failed check is reported even after an interrupt
    }

    /// <summary>Builds the tool with all its commands.</summary>
    // Not a RootCommand: that is named after the assembly, which cannot be called as the tool is.
    internal static Command Root(ToolConsole console) => new("lagsim", "LagSim: a shared physical world without lag. Results go to stdout, progress to stderr.")
    {
        new HelpOption { Action = new HelpOfTool(isAsked: true) },
        new VersionOption(),
        CheckCommand.Create(console),
        DropCommand.Create(console),
        PlayCommand.Create(console),
        CompareCommand.Create(console),
        SweepCommand.Create(console),
        StallsCommand.Create(console),
        HarmCommand.Create(console),
        HoldCommand.Create(console),
        AccuracyCommand.Create(console),
        HardCommand.Create(console),
        FuzzCommand.Create(console),
        RunCommand.Create(console),
        ScenesCommand.Create(console),
        ExplainCommand.Create(console),
        HostCommand.Create(console),
        JoinCommand.Create(console),
        KeyCommand.Create(console),
        TokenCommand.Create(console),
        RelayCommand.Create(console),
        DiffCommand.Create(console),
        ReplayCommand.Create(console),
    };

    /// <summary>Runs the tool once, until it is done or cancelled.</summary>
    /// <param name="arguments">The command line.</param>
    /// <param name="output">Receives the results.</param>
    /// <param name="error">Receives progress and errors.</param>
    /// <param name="stop">Cancels the run.</param>
    /// <param name="signal">Returns the exit code of the signal that cancelled it; null for that of an interrupt.</param>
    internal static int Run(string[] arguments, TextWriter output, TextWriter error, CancellationToken stop, Func<int?>? signal = null)
    {
        Command root = Root(new ToolConsole(output, error, stop));
        root.Action = new HelpOfTool(isAsked: false); // a call without a command
        ParseResult parsed = root.Parse(arguments);
        if (parsed.Errors.Count > 0)
        {
            Command asked = parsed.CommandResult.Command;
            string[] problems = Problems(parsed, isOfRoot: asked == root);
            foreach (string problem in problems)
            {
                error.WriteLine(Sentence.Printable(problem));
            }

            error.WriteLine(HelpOf(asked, root));
            return Failure.Tell(output, parsed, string.Join(" ", problems), ExitCode.Usage);
        }

        if (MistakenOption(parsed) is string option)
        {
            string sentence = OtherName(parsed, option) ?? $"There is no option '{option}'; what is no option and begins so stands behind '--'.";
            error.WriteLine(Sentence.Printable(sentence));
            error.WriteLine(HelpOf(parsed.CommandResult.Command, root));
            return Failure.Tell(output, parsed, sentence, ExitCode.Usage);
        }

        try
        {
            int code = parsed.Invoke(new InvocationConfiguration { Output = output, Error = error, EnableDefaultExceptionHandler = false });
            output.Flush();
            return code;
        }
        catch (OperationCanceledException) when (stop.IsCancellationRequested)
        {
            int code = signal?.Invoke() ?? ExitCode.Interrupted;
            error.WriteLine("Interrupted before there was a result.");
            return Failure.Tell(output, parsed, "interrupted", code);
        }
        catch (IOException failure) when (StandardOutput.IsClosedPipe(failure))
        {
            return ExitCode.ClosedPipe;
        }
        catch (UsageException mistake)
        {
            error.WriteLine(Sentence.Printable(mistake.Message));
            error.WriteLine(HelpOf(parsed.CommandResult.Command, root));
            return Failure.Tell(output, parsed, mistake.Message, ExitCode.Usage);
        }
        catch (Exception failure) when (failure is SceneFileException or SceneException or SimulationException or PeerGroupException
            or HandMotionException or InputException or IOException or UnauthorizedAccessException)
        {
            error.WriteLine(Sentence.Printable(Sentence.Of(failure)));
            return Failure.Tell(output, parsed, Sentence.Of(failure), ExitCode.Input);
        }
    }

    /// <summary>Says where the help is, after each mistake in a command line.</summary>
    private static string HelpOf(Command command, Command root) => command == root ? "Try 'lagsim --help'." : $"Try 'lagsim {command.Name} --help'.";

    /// <summary>
    /// Returns what is wrong with a command line, a sentence each. For an unknown command it returns only that.
    /// </summary>
    private static string[] Problems(ParseResult parsed, bool isOfRoot)
    {
        string[] all = [.. parsed.Errors.Select(problem => Missing(problem, parsed.CommandResult.Command) ?? problem.Message)];
        string[] ofWords = [.. all.Where(message => parsed.UnmatchedTokens.Any(word => message.Contains($"'{word}'", StringComparison.Ordinal)))];
        string[] problems = isOfRoot && ofWords.Length > 0 ? ofWords : all;
        return [.. problems, .. parsed.UnmatchedTokens.Select(word => OtherName(parsed, word)).OfType<string>()];
    }

    /// <summary>Names the argument that a problem says is missing; null for another problem.</summary>
    private static string? Missing(ParseError problem, Command command) =>
        problem.SymbolResult is ArgumentResult { Tokens.Count: 0 } result
            ? $"{result.Argument.Name} is missing: lagsim {command.Name} {string.Join(' ', command.Arguments.Select(argument => argument.Name))}." : null;

    /// <summary>
    /// Returns a hint if a duration option was given under the name that other commands use; else null.
    /// </summary>
    private static string? OtherName(ParseResult parsed, string word)
    {
        string? other = word == "--for-s" ? "--until-s" : word == "--until-s" ? "--for-s" : null;
        Command command = parsed.CommandResult.Command;
        return command.Options.Any(option => option.Name == other) ? $"{command.Name} has no option '{word}'; here it is {other}." : null;
    }

    /// <summary>Returns an argument that looks like a misspelt option; null for none.</summary>
    private static string? MistakenOption(ParseResult parsed) => parsed.Tokens.Any(token => token.Type == TokenType.DoubleDash) ? null
        : parsed.CommandResult.Children.OfType<ArgumentResult>().SelectMany(argument => argument.Tokens)
            .Select(token => token.Value).FirstOrDefault(word => word.Length > 1 && word[0] == '-');
}
