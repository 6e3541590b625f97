using System;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>One setting of a method. Immutable.</summary>
/// <param name="Text">The setting in words: <c>1/60 s</c>, <c>exact</c>.</param>
/// <param name="StepSeconds">The step in seconds; NaN for none.</param>
/// <param name="Tolerance">The tolerance of error control, in metres and m/s; NaN for none.</param>
/// <param name="ContactTolerance">The scene's contact tolerance in metres; NaN for the scene's own.</param>
public sealed record WorkSetting(string Text, double StepSeconds, double Tolerance = double.NaN, double ContactTolerance = double.NaN)
{
    /// <summary>A setting with a tolerance for each step.</summary>
    internal static WorkSetting Within(double tolerance) => new(FormattableString.Invariant($"tolerance {tolerance:0.#e+0}"), double.NaN, tolerance);

    /// <summary>A setting with a contact tolerance.</summary>
    internal static WorkSetting Contact(double metres) =>
        new(FormattableString.Invariant($"d={metres:0.#########}"), double.NaN, double.NaN, metres);

    /// <summary>A setting with a number of steps per second.</summary>
    internal static WorkSetting Rate(double hertz) => new(FormattableString.Invariant($"1/{hertz:0.###} s"), 1 / hertz);

    /// <summary>A setting of a method without steps.</summary>
    internal static WorkSetting None { get; } = new("no step", double.NaN);
}
