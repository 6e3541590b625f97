using System;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>One setting of a method. Immutable.</summary>
/// <param name="Text">In words: <c>1/60 s</c>, <c>exact</c>.</param>
/// <param name="StepSeconds">The step in seconds; NaN for none.</param>
/// <param name="Tolerance">What an error may be, in metres and m/s, under error control; NaN for none.</param>
/// <param name="ContactTolerance">The scene's contact tolerance in metres; NaN for the scene's own.</param>
public sealed record WorkSetting(string Text, double StepSeconds, double Tolerance = double.NaN, double ContactTolerance = double.NaN)
{
    /// <summary>An error of that much a step.</summary>
    internal static WorkSetting Within(double tolerance) => new(FormattableString.Invariant($"tolerance {tolerance:0.#e+0}"), double.NaN, tolerance);

    /// <summary>That contact tolerance.</summary>
    internal static WorkSetting Contact(double metres) =>
        new(FormattableString.Invariant($"d={metres:0.#########}"), double.NaN, double.NaN, metres);

    /// <summary>That many steps a second.</summary>
    internal static WorkSetting Rate(double hertz) => new(FormattableString.Invariant($"1/{hertz:0.###} s"), 1 / hertz);

    /// <summary>A method without a step.</summary>
    internal static WorkSetting None { get; } = new("no step", double.NaN);
}
