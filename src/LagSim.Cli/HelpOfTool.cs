using System;
using System.CommandLine;
using System.CommandLine.Help;
using System.CommandLine.Invocation;

namespace LagSim.Cli;

/// <summary>The help of every command.</summary>
/// <remarks>No line is longer than <see cref="MaxColumns"/>. The list of all commands has one sentence for each.</remarks>
internal sealed class HelpOfTool : SynchronousCommandLineAction
{
    /// <summary>The longest line, in characters; a narrower terminal gets shorter lines.</summary>
    internal const int MaxColumns = 100;

    private readonly HelpAction help = new();

    /// <param name="isAsked">Whether the help was asked for: then no other mistake on the command line counts.</param>
    internal HelpOfTool(bool isAsked) => ClearsParseErrors = isAsked;

    /// <inheritdoc/>
    public override bool ClearsParseErrors { get; }

    /// <inheritdoc/>
    public override int Invoke(ParseResult parseResult)
    {
        foreach (Command command in parseResult.CommandResult.Command.Subcommands)
        {
            command.Description = FirstSentence(command.Description ?? "");
        }

        help.MaxWidth = help.MaxWidth is > 0 and < MaxColumns ? help.MaxWidth : MaxColumns;
        return help.Invoke(parseResult);
    }

    private static string FirstSentence(string text) =>
        text.IndexOf(". ", StringComparison.Ordinal) is >= 0 and int end ? text[..(end + 1)] : text;
}
