using System;
using LagSim.Time;

namespace LagSim.Net.Display;

/// <summary>How corrections are hidden from the eye.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class DisplayOptions
{
    /// <summary>Options, each with its default.</summary>
    /// <param name="fastest">The time constant by which the smallest corrections decay, 1 ms to 10 s; default 80 ms.</param>
    /// <param name="slowest">That of the largest, from <paramref name="fastest"/> to 10 s; default 300 ms.</param>
    /// <param name="smallCorrection">
    /// Up to what size corrections count as smallest: above 0 m; default 0.05 m. In between the time constant grows in proportion.
    /// </param>
    /// <param name="largeCorrection">
    /// From what size on they count as largest: above <paramref name="smallCorrection"/>; default 1 m.
    /// </param>
    /// <param name="maxSpeed">How fast an offset shrinks at most, in m/s, above 0; default 10 m/s.</param>
    /// <param name="snapDistance">
    /// What is off by more than that, in metres, is not smoothed but shown at once: at least 0; default 5 m.
    /// </param>
    /// <param name="hiding">
    ///  A bounce hides an offset of its change of velocity times this, 0 to 1 s; default 50 ms. The eye does not see where exactly a ball
    /// that changes by 10 m/s was, half a metre more or less.
    /// </param>
    /// <param name="penetration">
    /// How deep an offset may let a body be drawn inside another thing, in metres, at least 0; default 1 mm.
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

    /// <summary>Up to what size corrections count as smallest, in metres.</summary>
    public double SmallCorrection { get; }

    /// <summary>From what size on corrections count as largest, in metres.</summary>
    public double LargeCorrection { get; }

    /// <summary>How fast an offset shrinks at most, in m/s.</summary>
    public double MaxSpeed { get; }

    /// <summary>What is off by more is shown at once; metres.</summary>
    public double SnapDistance { get; }

    /// <summary>What a bounce hides, as metres for each m/s by which it changes the velocity.</summary>
    public SimDuration Hiding { get; }

    /// <summary>How deep an offset may let a body be drawn inside another thing, in metres.</summary>
    public double Penetration { get; }

    private static SimDuration Span(SimDuration value, SimDuration least, SimDuration most, string name) => value >= least && value <= most
        ? value
        : throw new ArgumentOutOfRangeException(name, value.ToShortString(), $"This span must lie between {least.ToShortString()} and {most.ToShortString()}.");

    private static double Number(double value, bool isAllowed, string name, string allowed) => isAllowed && !double.IsInfinity(value)
        ? value
        : throw new ArgumentOutOfRangeException(name, value, $"This must be a finite number {allowed}.");
}
