using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Strategies;

namespace LagSim.Play;

/// <summary>Everything that a person can set up on the page: what a link to it carries.</summary>
/// <remarks>Immutable. Two playgrounds of one set-up show the same to the bit, as long as nobody does anything.</remarks>
internal sealed record PlaySetup
{
    /// <summary>The most panes.</summary>
    internal const int MaxPanes = 4;

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
        (PlaySetup setup, IReadOnlyList<WrongPart> wrong) = SetupReader.Read(query);
        return wrong.Count == 0 ? setup : throw new FormatException(wrong[0].Sentence);
    }

    /// <summary>The query that <see cref="Parse"/> reads back; of what has its default, nothing.</summary>
    internal string ToQuery()
    {
        PlaySetup usual = new();
        return string.Join('&', Names
            .Where(name => ValueOf(name) is string value && (name is "scene" or "panes" || value != usual.ValueOf(name)))
            .Select(name => $"{name}={ValueOf(name)}"));
    }

    /// <summary>The names of all parts, in the order in which a link has them.</summary>
    internal static IReadOnlyList<string> Names { get; } = ["scene", "panes", "link", .. SetupNumber.All.Select(number => number.Name)];

    /// <summary>A part as a link has it; null for a name that is none, and for a number of a link that a profile has.</summary>
    internal string? ValueOf(string name) => name switch
    {
        "scene" => Scene,
        "panes" => string.Join(',', Strategies.Select(NameOf)),
        "link" => Link.Profile,
        _ => SetupNumber.All.FirstOrDefault(number => number.Name == name) is SetupNumber number && !(number.IsOfLink && Link.Profile != LinkSettings.Custom)
            ? number.Text(number.Get(this)) : null,
    };

    /// <summary>The names of the strategies, as the tool and links have them, the simplest first.</summary>
    internal static IReadOnlyList<string> StrategyNames => LateEventStrategies.Names;

    /// <summary>The name of a strategy.</summary>
    internal static string NameOf(LateEventStrategy strategy) =>
        StrategyNames.First(name => LateEventStrategies.OfName(name) == strategy);
}
