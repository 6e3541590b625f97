using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary>The options that host and join share.</summary>
internal sealed class SessionArguments
{
    internal const double MinLength = 0.1;

    private const double DefaultTimeoutSeconds = 10;
    private const double DefaultRejoinSeconds = 120;
    private const double MaxKeepAliveSeconds = 2;

    private readonly KeyOptions key = new();

    private readonly Option<string> name = new("--name")
    {
        Description = $"What the others are shown as this peer's name; up to {SessionOptions.MaxNameBytes} bytes of UTF-8. None by default.",
        HelpName = "TEXT",
    };

    private readonly Option<string> role = CommonOptions.Word(
        "--as", "As what to take part; a spectator takes no player's place, and does nothing.", "player", "player", "spectator", "bot");

    private readonly Option<string[]> actions = new("--do") { Description = $"Do something: {ScriptedAction.Syntax}", HelpName = "ACTION" };
    private readonly Option<double?> length = Seconds(
        "--for-s", "How long to take part, counted from the session's start; by default until Ctrl-C.",
        MinLength, ScriptedAction.MaxSeconds);
    private readonly Option<string?> record = CommonOptions.File("--record", "Record the session in this file, whose name usually ends in .lagsim; an"
        + " existing file is replaced. Each time a fresh copy of the world is taken, as after a rejoin, the recording goes on in another file: after game.lagsim"
        + " come game.2.lagsim, game.3.lagsim and so on. The summary names them all.");
    private readonly Option<double> timeout = CommonOptions.Number(
        "--timeout-s", "How long another peer may be silent before it is disconnected; must be the same for all",
        DefaultTimeoutSeconds, 0.5, 600);

    private readonly Option<double> rejoin = CommonOptions.Number(
        "--rejoin-s", "How long a client that lost its host tries to join again, and how long a host keeps a lost client's number",
        DefaultRejoinSeconds, 0, 3600);

    internal SessionArguments()
    {
        name.Validators.Add(result =>
        {
            if (result.Tokens.Count == 1 && SessionOptions.WhyNoName(result.Tokens[0].Value) is string why)
            {
                result.AddError($"--name is not one to show: {why}");
            }
        });
        actions.Validators.Add(result =>
        {
            foreach (System.CommandLine.Parsing.Token token in result.Tokens)
            {
                try
                {
                    ScriptedAction.Parse(token.Value);
                }
                catch (UsageException wrong)
                {
                    result.AddError(wrong.Message);
                }
            }
        });
    }

    internal void AddTo(Command command)
    {
        key.AddTo(command);
        command.Options.Add(name);
        command.Options.Add(role);
        command.Options.Add(actions);
        command.Options.Add(length);
        command.Options.Add(record);
        command.Options.Add(timeout);
        command.Options.Add(rejoin);
    }

    /// <summary>Whether the connect key comes from standard input, of which <see cref="Read"/> then takes a line.</summary>
    internal bool ReadsInput(ParseResult parsed) => key.ReadsInput(parsed);

    /// <summary>Reads the options; of the session's options, those that both sides have.</summary>
    /// <exception cref="InputException">There is no connect key where it should be.</exception>
    /// <exception cref="UsageException">The options contradict each other.</exception>
    /// <exception cref="System.IO.IOException">The recording cannot be written.</exception>
    /// <exception cref="UnauthorizedAccessException">The recording cannot be written, for lack of permission.</exception>
    internal SessionRequest Read(ParseResult parsed, System.IO.TextReader input)
    {
        double? seconds = parsed.GetValue(length);
        string[] texts = parsed.GetValue(actions) ?? [];
        ScriptedAction[] ordered = texts.Select(ScriptedAction.Parse).OrderBy(action => action.Seconds).ToArray();
        if (ordered.FirstOrDefault(action => (action.At ?? action.Seconds) >= seconds) is ScriptedAction late)
        {
            throw new UsageException(string.Create(CultureInfo.InvariantCulture, $"--do is '{late.Text}', which is not before the end, --for-s {seconds}."));
        }

        PeerRole chosen = Enum.Parse<PeerRole>(parsed.GetValue(role)!, ignoreCase: true);
        if (chosen == PeerRole.Spectator && ordered.Length > 0)
        {
            throw new UsageException($"--as spectator contradicts --do '{ordered[0].Text}': a spectator does nothing.");
        }

        string? file = parsed.GetValue(record);
        if (file == ResultFile.StandardOutput)
        {
            throw new UsageException("--record is '-'; a recording is not for stdout, it must be a file.");
        }

        if (file is not null)
        {
            ResultFile.ThrowIfNotWritable("--record", file); // report this before joining
        }

        double silence = parsed.GetValue(timeout);
        ClientOptions options = new()
        {
            ConnectKey = key.Read(parsed, input),
            Name = parsed.GetValue(name) ?? "",
            Role = chosen,
            Timeout = SimDuration.FromSeconds(silence),
            RejoinTime = SimDuration.FromSeconds(parsed.GetValue(rejoin)),
            KeepAlive = SimDuration.FromSeconds(Math.Min(MaxKeepAliveSeconds, silence / 4)),
        };
        return new SessionRequest(options, ordered, seconds, file);
    }

    /// <summary>An optional number of seconds.</summary>
    internal static Option<double?> Seconds(string name, string description, double least, double most) => new(name)
    {
        Description = string.Create(CultureInfo.InvariantCulture, $"{description} ({least} to {most})"),
        HelpName = "NUMBER",
        CustomParser = result => CommonOptions.ParseNumber(result, name, least, most),
    };
}

/// <summary>A request to take part in a session.</summary>
/// <param name="Options">The session's options.</param>
/// <param name="Actions">The scripted actions, in order of time.</param>
/// <param name="Seconds">The duration, counted from the session's start; null until cancelled.</param>
/// <param name="RecordFile">The file to record to; null for none.</param>
internal sealed record SessionRequest(SessionOptions Options, IReadOnlyList<ScriptedAction> Actions, double? Seconds, string? RecordFile)
{
    /// <summary>Where the host is, for a client, as the user wrote it; null for a host.</summary>
    internal string? Host { get; init; }

    /// <summary>The same as <see cref="Seconds"/>.</summary>
    internal SimDuration? Length => Seconds is double seconds ? SimDuration.FromSeconds(seconds) : null;
}
