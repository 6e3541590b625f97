using System;
using LagSim.Time;

namespace LagSim.Net.Display;

/// <summary>How visible corrections are smoothed.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class DisplayOptions
{
    /// <summary>Creates options, each with its default.</summary>
    /// <param name="fastest">The time constant with which the smallest corrections decay, 1 ms to 10 s; default 80 ms.</param>
    /// <param name="slowest">The time constant of the largest corrections, from <paramref name="fastest"/> to 10 s; default 300 ms.</param>
    /// <param name="smallCorrection">
    /// The size up to which corrections count as smallest: above 0 m; default 0.05 m. In between the time constant grows in proportion.
    /// </param>
    /// <param name="largeCorrection">
    /// The size from which corrections count as largest: above <paramref name="smallCorrection"/>; default 1 m.
    /// </param>
    /// <param name="maxSpeed">The greatest speed at which an offset shrinks, in m/s, above 0; default 10 m/s.</param>
    /// <param name="snapDistance">
    /// The size in metres above which a correction is shown at once instead of smoothed: at least 0; default 5 m.
    /// </param>
    /// <param name="hiding">
    /// A bounce hides an offset of its velocity change times this, 0 to 1 s; default 50 ms. The eye cannot tell within half a metre where a
    /// ball was that changes by 10 m/s.
    /// </param>
    /// <param name="penetration">
    /// How deep an offset may let a body be drawn inside something else, in metres, at least 0; default 1 mm.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of range.</exception>
    public DisplayOptions(
        SimDuration? fastest = null,
        SimDuration? slowest = null,
        double smallCorrection = 0.05,
        double largeCorrection = 1,
        double maxSpeed = 10,
        double snapDistance = 5,
        SimDuration? hiding = null,
        double penetration = 0.001)
    {
        SimDuration longest = SimDuration.FromSeconds(10);
        Fastest = Span(fastest ?? SimDuration.FromMilliseconds(80), SimDuration.FromMilliseconds(1), longest, nameof(fastest));
        Slowest = Span(slowest ?? SimDuration.FromMilliseconds(300), Fastest, longest, nameof(slowest));
        SmallCorrection = Number(smallCorrection, smallCorrection > 0, nameof(smallCorrection), "above 0 m");
        LargeCorrection = Number(largeCorrection, largeCorrection > smallCorrection, nameof(largeCorrection), $"above {nameof(smallCorrection)},"
            + $" {smallCorrection} m");
        MaxSpeed = Number(maxSpeed, maxSpeed > 0, nameof(maxSpeed), "above 0 m/s");
        SnapDistance = Number(snapDistance, snapDistance >= 0, nameof(snapDistance), "at least 0 m");
        Hiding = Span(hiding ?? SimDuration.FromMilliseconds(50), SimDuration.Zero, SimDuration.FromSeconds(1), nameof(hiding));
        Penetration = Number(penetration, penetration >= 0, nameof(penetration), "at least 0 m");
    }

    /// <summary>The time constant of the smallest corrections.</summary>
    public SimDuration Fastest { get; }

    /// <summary>The time constant of the largest corrections.</summary>
    public SimDuration Slowest { get; }

    /// <summary>The size up to which corrections count as smallest, in metres.</summary>
    public double SmallCorrection { get; }

    /// <summary>The size from which corrections count as largest, in metres.</summary>
    public double LargeCorrection { get; }

    /// <summary>The greatest speed at which an offset shrinks, in m/s.</summary>
    public double MaxSpeed { get; }

    /// <summary>The size above which a correction is shown at once, in metres.</summary>
    public double SnapDistance { get; }

    /// <summary>The offset that a bounce hides, in metres for each m/s of velocity change.</summary>
    public SimDuration Hiding { get; }

    /// <summary>How deep an offset may let a body be drawn inside something else, in metres.</summary>
    public double Penetration { get; }

    private static SimDuration Span(SimDuration value, SimDuration least, SimDuration most, string name) => value >= least && value <= most
        ? value
        : throw new ArgumentOutOfRangeException(name, value.ToShortString(), $"This span must lie between {least.ToShortString()} and {most.ToShortString()}.");

    private static double Number(double value, bool isAllowed, string name, string allowed) => isAllowed && !double.IsInfinity(value)
        ? value
        : throw new ArgumentOutOfRangeException(name, value, $"This must be a finite number {allowed}.");
}
