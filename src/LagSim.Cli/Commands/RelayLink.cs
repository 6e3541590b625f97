using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Testing.Links;

namespace LagSim.Cli.Commands;

/// <summary>The options that say what link <c>lagsim relay</c> simulates: the name of a profile, or figures, the same both ways.</summary>
internal sealed class RelayLink
{
    /// <summary>How long a datagram may wait before a line of a given rate, in milliseconds, as at <c>modem-64k</c>.</summary>
    private const double QueueMilliseconds = 1_000;

    private const double MaxKilobits = Bottleneck.MaxBitsPerSecond / 1_000;

    private readonly Option<string?> profile = CommonOptions.Profile();
    private readonly Option<double?> delay = Figure("--delay-ms", "The mean delay one way", 0, LinkProfiles.MaxPureDelay);
    private readonly Option<double?> jitter = Figure("--jitter-ms", "The standard deviation of the delay", 0, LinkProfiles.MaxPureDelay);
    private readonly Option<double?> loss = Figure("--loss-percent", "How much is lost, datagram by datagram", 0, 100);
    private readonly Option<double?> rate = Figure(
        "--rate-kbps", "The rate of the line, in kbit/s, with a queue of 1 s before it; unlimited by default", 1, MaxKilobits);

    private Option<double?>[] Figures => [delay, jitter, loss, rate];

    internal void AddTo(Command command)
    {
        command.Options.Add(profile);
        foreach (Option<double?> figure in Figures)
        {
            command.Options.Add(figure);
        }
    }

    /// <summary>Returns the link that was asked for.</summary>
    /// <exception cref="UsageException">None was, or the name of one and figures too, or the profile is unknown.</exception>
    internal RelayLinkChoice Read(ParseResult parsed)
    {
        string? name = parsed.GetValue(profile);
        Option<double?>[] given = [.. Figures.Where(figure => parsed.GetValue(figure) is not null)];
        if (name is null && given.Length == 0)
        {
            throw new UsageException($"The link is missing: --profile NAME, or figures, any of {string.Join(", ", Figures.Select(figure => figure.Name))}.");
        }

        if (name is null)
        {
            return RelayLinkChoice.Of(
                parsed.GetValue(delay) ?? 0, parsed.GetValue(jitter) ?? 0, parsed.GetValue(loss) ?? 0, parsed.GetValue(rate), QueueMilliseconds);
        }

        if (given.Length > 0)
        {
            throw new UsageException($"{given[0].Name} and --profile exclude each other: a profile has figures of its own.");
        }

        return LinkProfiles.TryGet(name, out LinkProfile? link, out string? error) ? new RelayLinkChoice(link) : throw new UsageException(error);
    }

    private static Option<double?> Figure(string name, string description, double least, double most) => new(name)
    {
        Description = string.Create(CultureInfo.InvariantCulture, $"{description} ({least} to {most}). Cannot be combined with --profile."),
        HelpName = "NUMBER",
        CustomParser = result => CommonOptions.ParseNumber(result, name, least, most),
    };
}

/// <summary>The link that a relay simulates.</summary>
/// <param name="Link">The link; its name is what the summary calls it.</param>
internal sealed record RelayLinkChoice(LinkProfile Link)
{
    /// <summary>The figures, by the keys of the summary; null each if the link was chosen by name.</summary>
    internal IReadOnlyList<(string Key, double? Value)> Figures { get; private init; } = Named(null, null, null, null);

    /// <summary>Whether it was given by figures.</summary>
    internal bool IsByFigures { get; private init; }

    /// <summary>The link of these figures, the same both ways.</summary>
    internal static RelayLinkChoice Of(double delay, double jitter, double loss, double? kilobits, double queue)
    {
        double burst = loss < 100 ? 100 / (100 - loss) : 1; // so that no loss makes another likelier
        Bottleneck? line = kilobits is double rate ? new Bottleneck((long)(rate * 1_000), queue) : null;
        LinkLeg leg = new(delay, jitter, loss, burst) { Bottleneck = line };
        string name = string.Create(
            CultureInfo.InvariantCulture,
            $"{delay} ms, jitter {jitter} ms, {loss} % lost{(kilobits is null ? "" : string.Create(CultureInfo.InvariantCulture, $", {kilobits} kbit/s"))}");
        return new RelayLinkChoice(new LinkProfile(name, leg)) { Figures = Named(delay, jitter, loss, kilobits), IsByFigures = true };
    }

    private static (string, double?)[] Named(double? delay, double? jitter, double? loss, double? rate) =>
        [("delay_ms", delay), ("jitter_ms", jitter), ("loss_percent", loss), ("rate_kbps", rate)];
}
