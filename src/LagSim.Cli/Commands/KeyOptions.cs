using System;
using System.CommandLine;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary>The connect key, from the command line, standard input or a file: other users of a machine can read command lines.</summary>
internal sealed class KeyOptions
{
    private const string Input = "-";

    private readonly Option<string?> key = new("--key")
    {
        Description = $"A secret that clients must present; up to {SessionOptions.MaxKeyLength} characters. None by default. - reads it from a line of"
            + " standard input: other users of this machine can see a command line. Blanks around it count.",
        HelpName = "TEXT",
    };

    private readonly Option<string?> file = CommonOptions.File("--key-file", "Read the key from this file, which holds it on a line of its own. Blanks around it count, as in --key.");

    internal KeyOptions() => key.Validators.Add(result =>
    {
        string? text = result.Tokens.Count == 1 ? result.Tokens[0].Value : null;
        if (text?.Length is 0 or > SessionOptions.MaxKeyLength)
        {
            result.AddError(text.Length == 0 ? $"--key is empty; it must be 1 to {SessionOptions.MaxKeyLength} characters. Without --key there is no key."
                : $"--key has {text.Length} characters; at most {SessionOptions.MaxKeyLength} are allowed.");
        }
        else if (text is not null && ConnectKeyText.WhyNone(text) is string why)
        {
            result.AddError($"--key {why}");
        }
    });

    internal void AddTo(Command command)
    {
        command.Options.Add(key);
        command.Options.Add(file);
    }

    /// <summary>Whether the key comes from standard input.</summary>
    internal bool ReadsInput(ParseResult parsed) => parsed.GetValue(key) == Input;

    /// <summary>Reads the key; empty for none.</summary>
    /// <exception cref="UsageException">Both options are there.</exception>
    /// <exception cref="InputException">There is no key where it should be.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal string Read(ParseResult parsed, TextReader input)
    {
        string? text = parsed.GetValue(key);
        if (parsed.GetValue(file) is not string name)
        {
            return text == Input ? Checked(input.ReadLine(), "--key is '-', and standard input") : text ?? "";
        }

        return text is not null ? throw new UsageException("--key contradicts --key-file; leave out one of them.")
            : Checked(SecretFile.ReadLine(name) ?? throw new InputException($"--key-file is '{name}'; there is no such file."), $"--key-file is '{name}', which");
    }

    private static string Checked(string? key, string where) => key is not null && ConnectKeyText.WhyNone(key) is not null
        ? throw new InputException($"{where} does not hold a key: it is not valid UTF-8.")
        : key is { Length: > 0 and <= SessionOptions.MaxKeyLength } && !key.Contains('\n', StringComparison.Ordinal) ? key
        : throw new InputException($"{where} does not hold a key: a line of 1 to {SessionOptions.MaxKeyLength} characters.");
}
