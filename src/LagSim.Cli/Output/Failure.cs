using System.CommandLine;
using System.CommandLine.Parsing;
using System.IO;
using System.Linq;
using LagSim.Cli.Commands;

namespace LagSim.Cli.Output;

/// <summary>A failed command as a JSON document, with the message that is also on stderr.</summary>
internal static class Failure
{
    /// <summary>Writes the document if JSON was requested, and returns the exit code.</summary>
    internal static int Tell(TextWriter output, ParseResult parsed, string sentence, int exitCode)
    {
        Command command = parsed.CommandResult.Command;
        if (!IsGiven(parsed, command, CommonOptions.JsonName))
        {
            return exitCode;
        }

        ulong? seed = parsed.Errors.Count == 0 ? parsed.GetValue<ulong>(CommonOptions.SeedName) : null;
        try
        {
            Write(output, command.Name, seed, sentence, exitCode);
            output.Flush();
        }
        catch (IOException)
        {
            // The reader has gone; the message is on stderr.
        }

        return exitCode;
    }

    /// <summary>Writes the document.</summary>
    internal static void Write(TextWriter output, string command, ulong? seed, string sentence, int exitCode) =>
        JsonDocumentWriter.Write(output, command, seed, null, null, null, json =>
        {
            json.WriteString("error", sentence);
            json.WriteNumber("exit_code", exitCode);
        });

    private static bool IsGiven(ParseResult parsed, Command command, string name) =>
        command.Options.FirstOrDefault(option => option.Name == name) is Option option && parsed.GetResult(option) is OptionResult { Implicit: false };
}
