using System;
using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The descriptions of the kinds of error that columns of files name.</summary>
public static class WorkErrorKinds
{
    private static readonly Dictionary<string, WorkErrorWords> All = new()
    {
        ["max_position_error_m"] = new("largest distance of the body from its true place, in metres", "largest distance from the true place (m)", "error m", "m"),
        ["rms_position_m"] = new("distance of the bodies from their true places, rms over all of them, in metres", "rms distance from the true places (m)", "error m", "m"),
        ["max_energy_relative"] = new("largest relative error of the energy", "largest error of the energy (relative)", "energy", "of the energy"),
        [ContactWork.Overlap] = new("deepest overlap, in metres", "deepest overlap (m)", "overlap m", "m"),
        [ContactWork.EnergyGain] = new(
            "most energy gained over all that went before, as part of that at the start",
            "most energy gained (of that at the start)", "gained",
            "of the energy"),
        [ContactWork.Drift] = new(
            "furthest that a ball moves in the last second, in metres",
            "furthest that a ball moves in the last second (m)", "drift m", "m"),
        [ContactWork.Moved] = new(
            "furthest that a ball is from where it started, in metres", "furthest that a ball is from its start (m)", "moved m", "m"),
        ["most_pairs_deeper_than_1_mm"] = new("most pairs at one time that overlap by more than 1 mm", "most pairs that overlap by more than 1 mm", "pairs", "pairs"),
    };

    /// <summary>Returns the description of a kind.</summary>
    /// <exception cref="ArgumentException">There is no such kind.</exception>
    public static WorkErrorWords Of(string kind) => All.TryGetValue(kind, out WorkErrorWords? words) ? words
        : throw new ArgumentException($"There are no words for the kind of error '{kind}'; there are for {string.Join(", ", All.Keys)}.", nameof(kind));
}

/// <summary>A kind of error in words. Immutable.</summary>
/// <param name="Sentence">As part of a sentence, with its unit.</param>
/// <param name="Axis">As the label of an axis, with its unit in brackets.</param>
/// <param name="Heading">As the heading of a narrow column.</param>
/// <param name="Unit">The unit after a number.</param>
public sealed record WorkErrorWords(string Sentence, string Axis, string Heading, string Unit);
