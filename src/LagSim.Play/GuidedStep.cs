using System.Collections.Generic;

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
    IReadOnlyList<GuidedDeed> Deeds, IReadOnlyList<(string Text, string Query)> Variants);

/// <summary>What a button of a step does.</summary>
/// <param name="Text">What the button says.</param>
/// <param name="Strokes">What happens, all at once.</param>
internal sealed record GuidedDeed(string Text, IReadOnlyList<Stroke> Strokes);
