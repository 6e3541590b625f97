using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A path that changes periodically, as over a satellite that moves on: the mean delay steps up at one change and down at the next.
/// </summary>
/// <remarks>
/// Half of the step lies above the leg's delay, half below. Both directions of a link step at once. Immutable, safe on any thread.
/// </remarks>
public sealed class DelayStep
{
    /// <summary>Creates a step of that size for every change.</summary>
    /// <param name="periodSeconds">The time between changes, 0.001 to 86,400 s.</param>
    /// <param name="milliseconds">See <see cref="Milliseconds"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public DelayStep(double periodSeconds, double milliseconds)
    {
        Period = Cadence.Period(periodSeconds, nameof(periodSeconds));
        Milliseconds = milliseconds is > 0 and <= LinkLeg.MaxMilliseconds
            ? milliseconds
            : throw new ArgumentOutOfRangeException(nameof(milliseconds), milliseconds, $"A step is above 0 and at most {LinkLeg.MaxMilliseconds} ms.");
    }

    /// <summary>The time between changes.</summary>
    public SimDuration Period { get; }

    /// <summary>The change of the mean delay at each step, in milliseconds; above 0, at most twice the leg's delay.</summary>
    public double Milliseconds { get; }
}
