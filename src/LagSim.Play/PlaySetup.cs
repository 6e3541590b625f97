using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text;
using LagSim.Net.Strategies;

namespace LagSim.Play;

/// <summary>Everything that a person can set up on the page: what a link to it carries.</summary>
/// <remarks>Immutable. Two playgrounds of one set-up show the same to the bit, as long as nobody does anything.</remarks>
internal sealed record PlaySetup
{
    /// <summary>The most panes.</summary>
    internal const int MaxPanes = 4;

    private static readonly Number[] Numbers =
    [
        new("seed", 0, 1L << 53, s => s.Seed, (s, v) => s with { Seed = (ulong)v }, IsWhole: true),
        new("delay", 0, 2000, s => s.Link.DelayMilliseconds, (s, v) => s with { Link = s.Link with { DelayMilliseconds = v } }),
        new("jitter", 0, 500, s => s.Link.JitterMilliseconds, (s, v) => s with { Link = s.Link with { JitterMilliseconds = v } }),
        new("loss", 0, 50, s => s.Link.LossPercent, (s, v) => s with { Link = s.Link with { LossPercent = v } }),
        new("burst", 1, 20, s => s.Link.MeanBurstLength, (s, v) => s with { Link = s.Link with { MeanBurstLength = v } }),
        new(
            "asymmetry", -4000, 4000, s => s.Link.AsymmetryMilliseconds,
            (s, v) => s with { Link = s.Link with { AsymmetryMilliseconds = v } }),
        new(
            "clock", -3.6e6, 3.6e6, s => s.Link.ClockOffsetMilliseconds,
            (s, v) => s with { Link = s.Link with { ClockOffsetMilliseconds = v } }),
        new("ahead", 20, 1000, s => s.LookAheadMilliseconds, (s, v) => s with { LookAheadMilliseconds = v }),
        new("lag", 0, 500, s => s.LocalLagMilliseconds, (s, v) => s with { LocalLagMilliseconds = v }),
        new("smooth", 0, 1, s => s.IsSmooth ? 1 : 0, (s, v) => s with { IsSmooth = v != 0 }),
        new("speed", 0.05, 2, s => s.Speed, (s, v) => s with { Speed = v }),
    ];

    /// <summary>The name of the scene, one of <see cref="PlayScene.Names"/>.</summary>
    internal string Scene { get; init; } = "room";

    /// <summary>The strategy of each pane, two to four; the first pane is the host.</summary>
    internal IReadOnlyList<LateEventStrategy> Strategies { get; init; } = [LateEventStrategy.Healing, LateEventStrategy.Healing];

    /// <summary>The link between each client and the host.</summary>
    internal LinkSettings Link { get; init; } = new();

    /// <summary>The seed of the links.</summary>
    internal ulong Seed { get; init; } = 1;

    /// <summary>How far ahead each world is simulated, in milliseconds, 20 to 1,000, and no less than the local lag. A heal simulates all
    /// of it again, in each pane.</summary>
    internal double LookAheadMilliseconds { get; init; } = 100;

    /// <summary>How much later than now what a person does happens, in milliseconds, 0 to 500.</summary>
    internal double LocalLagMilliseconds { get; init; }

    /// <summary>Whether corrections are drawn as glides rather than jumps.</summary>
    internal bool IsSmooth { get; init; } = true;

    /// <summary>How fast time passes, 0.05 to 2.</summary>
    internal double Speed { get; init; } = 1;

    /// <summary>Reads the query of a link, without its question mark. What it does not name has its default.</summary>
    /// <exception cref="FormatException">A name or a value is not allowed; the message says which, and what is.</exception>
    internal static PlaySetup Parse(string query)
    {
        PlaySetup setup = new();
        foreach (string part in query.Split('&', StringSplitOptions.RemoveEmptyEntries))
        {
            int equals = part.IndexOf('=', StringComparison.Ordinal);
            string name = equals < 0 ? part : part[..equals], value = equals < 0 ? "" : Uri.UnescapeDataString(part[(equals + 1)..]);
            setup = name switch
            {
                "scene" => setup with { Scene = OneOf(name, value, PlayScene.Names) },
                "link" => setup with { Link = setup.Link with { Profile = OneOf(name, value, LinkSettings.Names) } },
                "panes" => setup with { Strategies = Panes(value) },
                _ => NumberNamed(name).Read(setup, value),
            };
        }

        setup.ThrowIfImpossible();
        return setup;
    }

    /// <summary>The query that <see cref="Parse"/> reads back; of what has its default, nothing.</summary>
    internal string ToQuery()
    {
        PlaySetup usual = new();
        StringBuilder query = new($"scene={Scene}&panes={string.Join(',', Strategies.Select(NameOf))}");
        if (Link.Profile != usual.Link.Profile)
        {
            query.Append("&link=").Append(Link.Profile);
        }

        foreach (Number number in Numbers.Where(n => n.Get(this) != n.Get(usual)))
        {
            query.Append('&').Append(number.Name).Append('=').Append(number.Get(this).ToString("R", CultureInfo.InvariantCulture));
        }

        return query.ToString();
    }

    /// <summary>The names of the strategies, as the tool and links have them, the simplest first.</summary>
    internal static IReadOnlyList<string> StrategyNames => LateEventStrategies.Names;

    /// <summary>The name of a strategy.</summary>
    internal static string NameOf(LateEventStrategy strategy) =>
        StrategyNames.First(name => LateEventStrategies.OfName(name) == strategy);

    private static Number NumberNamed(string name) => Array.Find(Numbers, number => number.Name == name) ?? throw new FormatException(
        $"'{name}' is no part of a set-up; there are scene, link, panes, {string.Join(", ", Numbers.Select(number => number.Name))}.");

    private static string OneOf(string name, string value, IReadOnlyList<string> allowed) =>
        allowed.Contains(value) ? value
            : throw new FormatException($"'{name}' is '{value}'; it must be one of {string.Join(", ", allowed)}.");

    private static LateEventStrategy[] Panes(string value)
    {
        string[] names = value.Split(',');
        return names.Length is >= 2 and <= MaxPanes
            ? [.. names.Select(name => LateEventStrategies.OfName(OneOf("panes", name, StrategyNames)))]
            : throw new FormatException($"'panes' names {names.Length} strategies; there are 2 to {MaxPanes} panes.");
    }

    private void ThrowIfImpossible()
    {
        if (Math.Abs(Link.AsymmetryMilliseconds) > 2 * Link.DelayMilliseconds)
        {
            throw new FormatException(string.Create(
                CultureInfo.InvariantCulture,
                $"'asymmetry' is {Link.AsymmetryMilliseconds} ms; with a delay of {Link.DelayMilliseconds} ms it can be"
                    + $" {2 * Link.DelayMilliseconds} ms at most, either way."));
        }

        if (LocalLagMilliseconds > LookAheadMilliseconds)
        {
            throw new FormatException(string.Create(
                CultureInfo.InvariantCulture,
                $"'lag' is {LocalLagMilliseconds} ms; with a look-ahead of {LookAheadMilliseconds} ms ('ahead') it can be that at most."));
        }

        try
        {
            Link.ToProfile();
        }
        catch (ArgumentException impossible)
        {
            throw new FormatException($"The link cannot be: {impossible.Message}", impossible);
        }
    }

    /// <summary>A number of a set-up: its name in a link, its range, and how it is read and written.</summary>
    private sealed record Number(
        string Name, double Least, double Most, Func<PlaySetup, double> Get, Func<PlaySetup, double, PlaySetup> Set, bool IsWhole = false)
    {
        internal PlaySetup Read(PlaySetup setup, string text) =>
            double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out double value) && value >= Least && value <= Most
                    && (!IsWhole || Math.Floor(value) == value)
                ? Set(setup, value)
                : throw new FormatException(string.Create(
                    CultureInfo.InvariantCulture,
                    $"'{Name}' is '{text}'; it must be a {(IsWhole ? "whole " : "")}number from {Least} to {Most}."));
    }
}
