using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
/// An estimate of how far another peer's clock is ahead of this one at any local time: an offset at one instant, the drift since, and the
/// errors of both.
/// </summary>
/// <remarks>Immutable, safe on any thread. Evaluated with integers only. <c>default</c> says that the two clocks are equal.</remarks>
internal readonly struct ClockEstimate
{
    /// <summary>The most that two clocks drift apart, in parts per million: 500. Two crystals differ by some 100.</summary>
    public const double MaxDrift = 500;

    private const int FractionBits = 32; // a unit is 0.00023 parts per million
    private const double UnitsPerMillionth = (1L << FractionBits) * 1e-6;
    private readonly long drift;
    private readonly long driftBound;

    /// <summary>Creates an estimate without error bounds.</summary>
    /// <param name="at">See <see cref="At"/>.</param>
    /// <param name="offset">See <see cref="Offset"/>.</param>
    /// <param name="driftPartsPerMillion">See <see cref="DriftPartsPerMillion"/>; within <see cref="MaxDrift"/> either way.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="driftPartsPerMillion"/> is not finite or out of range.</exception>
    public ClockEstimate(SimTime at, SimDuration offset, double driftPartsPerMillion = 0)
        : this(at, offset, driftPartsPerMillion * 1e-6, SimDuration.Zero, 0)
    {
        if (!(Math.Abs(driftPartsPerMillion) <= MaxDrift))
        {
            throw new ArgumentOutOfRangeException(
                nameof(driftPartsPerMillion), driftPartsPerMillion, $"Two clocks drift apart by at most {MaxDrift} parts per million either way.");
        }
    }

    /// <summary>Creates an estimate with error bounds; both drifts as fractions.</summary>
    internal ClockEstimate(SimTime at, SimDuration offset, double drift, SimDuration errorBound, double driftBound)
    {
        At = at;
        Offset = offset;
        ErrorBound = errorBound;
        this.drift = (long)Math.Round(drift * (1L << FractionBits));
        this.driftBound = (long)Math.Ceiling(driftBound * (1L << FractionBits));
    }

    /// <summary>The local time at which <see cref="Offset"/> holds.</summary>
    public SimTime At { get; }

    /// <summary>The other peer's clock minus the local one, at <see cref="At"/>.</summary>
    public SimDuration Offset { get; }

    /// <summary>The greatest error of <see cref="Offset"/>; zero if no bound was given.</summary>
    public SimDuration ErrorBound { get; }

    /// <summary>How much faster the other clock runs, in parts per million of the local one; negative if it is slower.</summary>
    public double DriftPartsPerMillion => drift / UnitsPerMillionth;

    /// <summary>The greatest error of <see cref="DriftPartsPerMillion"/>; zero if no bound was given.</summary>
    public double DriftErrorBound => driftBound / UnitsPerMillionth;

    /// <summary>The other peer's clock minus the local one, when that reads <paramref name="ownTime"/>.</summary>
    /// <exception cref="OverflowException">The result is out of range.</exception>
    public SimDuration OffsetAt(SimTime ownTime) => Offset + Share(drift, ownTime - At);

    /// <summary>The greatest error of <see cref="OffsetAt"/>: it grows with the distance from <see cref="At"/>.</summary>
    /// <exception cref="OverflowException">The result is out of range.</exception>
    public SimDuration ErrorBoundAt(SimTime ownTime)
    {
        SimDuration age = ownTime - At;
        return age == SimDuration.Zero ? ErrorBound : ErrorBound + Share(driftBound, age < SimDuration.Zero ? -age : age) + SimDuration.OneTick;
    }

    /// <summary>
    /// Rounded down, so that local time plus offset never goes back. Split in two, since the product of the whole would overflow.
    /// </summary>
    private static SimDuration Share(long units, SimDuration span) =>
        SimDuration.FromTicks(((span.Ticks >> FractionBits) * units) + (((span.Ticks & ((1L << FractionBits) - 1)) * units) >> FractionBits));
}
