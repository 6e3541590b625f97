using System.Collections.Generic;
using System.Linq;

namespace LagSim.Play;

/// <summary>One thing to try on the page: a set-up, what to do in it, and what to look at.</summary>
/// <param name="Name">Its name in a link.</param>
/// <param name="Title">What it is called.</param>
/// <param name="Subtitle">What it shows, in some words.</param>
/// <param name="Query">The set-up of the worlds, as a link has it; see <see cref="PlaySetup.Parse"/>.</param>
/// <param name="Sentences">What to look at, and why.</param>
/// <param name="Test">The name of the thesis's test that runs beside the worlds; null if there is none.</param>
/// <param name="Deeds">What a press of a button does in the worlds.</param>
/// <param name="Variants">Other set-ups to hold it against: what each is, and its query.</param>
internal sealed record GuidedStep(
    string Name, string Title, string Subtitle, string Query, IReadOnlyList<string> Sentences, string? Test,
    IReadOnlyList<GuidedDeed> Deeds, IReadOnlyList<(string Text, string Query)> Variants)
{
    /// <summary>What a set-up has otherwise than the step, in words, so that what the step says need not be so of it; none if it is that of
    /// the step or of a variant.</summary>
    /// <remarks>Seed and speed may be any: what the step says does not depend on them.</remarks>
    internal IReadOnlyList<string> ChangesIn(PlaySetup setup)
    {
        string[][] changes = [.. Variants.Select(variant => variant.Query).Prepend(Query).Select(query => Changes(PlaySetup.Parse(query), setup))];
        return changes.Any(none => none.Length == 0) ? [] : changes[0];
    }

    private static string[] Changes(PlaySetup own, PlaySetup setup) =>
    [
        .. PlaySetup.Names
            .Where(name => name is not ("seed" or "speed") && setup.ValueOf(name) is string value && value != own.ValueOf(name))
            .Select(name => own.ValueOf(name) is string before ? $"{name} is {setup.ValueOf(name)}, not {before}" : $"{name} is {setup.ValueOf(name)}"),
    ];
}

/// <summary>What a button of a step does.</summary>
/// <param name="Text">What the button says.</param>
/// <param name="Strokes">What happens, all at once.</param>
internal sealed record GuidedDeed(string Text, IReadOnlyList<Stroke> Strokes);
