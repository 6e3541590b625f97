using System;
using LagSim.Time;

namespace LagSim.Net.Clocks;

/// <summary>
///  How far another peer's clock is ahead of one's own, at any own time: an offset at one instant, the drift since, and how wrong both may
/// be.
/// </summary>
/// <remarks>Immutable, safe on any thread. Read with integers only. <c>default</c> says that the two clocks are the same.</remarks>
internal readonly struct ClockEstimate
{
    /// <summary>The most that two clocks drift apart, in parts per million: 500. Two crystals differ by some 100.</summary>
    public const double MaxDrift = 500;

    private const int FractionBits = 32; // a unit is 0.00023 parts per million
    private const double UnitsPerMillionth = (1L << FractionBits) * 1e-6;
    private readonly long drift;
    private readonly long driftBound;

    /// <summary>An estimate without a bound on its error.</summary>
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

    /// <summary>An estimate with bounds; both drifts as fractions.</summary>
    internal ClockEstimate(SimTime at, SimDuration offset, double drift, SimDuration errorBound, double driftBound)
    {
        At = at;
        Offset = offset;
        ErrorBound = errorBound;
        this.drift = (long)Math.Round(drift * (1L << FractionBits));
        this.driftBound = (long)Math.Ceiling(driftBound * (1L << FractionBits));
    }

    /// <summary>The own time at which <see cref="Offset"/> holds.</summary>
    public SimTime At { get; }

    /// <summary>The other peer's clock minus one's own, at <see cref="At"/>.</summary>
    public SimDuration Offset { get; }

    /// <summary>The most that <see cref="Offset"/> is wrong by; zero where no bound was given.</summary>
    public SimDuration ErrorBound { get; }

    /// <summary>How much faster the other clock runs, in parts per million of one's own; negative when it is slower.</summary>
    public double DriftPartsPerMillion => drift / UnitsPerMillionth;

    /// <summary>The most that <see cref="DriftPartsPerMillion"/> is wrong by; zero where no bound was given.</summary>
    public double DriftErrorBound => driftBound / UnitsPerMillionth;

    /// <summary>The other peer's clock minus one's own, when one's own reads <paramref name="ownTime"/>.</summary>
    /// <exception cref="OverflowException">The result is out of range.</exception>
    public SimDuration OffsetAt(SimTime ownTime) => Offset + Share(drift, ownTime - At);

    /// <summary>The most that <see cref="OffsetAt"/> is wrong by: it grows with the distance from <see cref="At"/>.</summary>
    /// <exception cref="OverflowException">The result is out of range.</exception>
    public SimDuration ErrorBoundAt(SimTime ownTime)
    {
        SimDuration age = ownTime - At;
        return age == SimDuration.Zero ? ErrorBound : ErrorBound + Share(driftBound, age < SimDuration.Zero ? -age : age) + SimDuration.OneTick;
    }

    /// <summary>
    /// Rounded down, so that own time plus offset never goes back. In two parts, for the product of the whole does not fit.
    /// </summary>
    private static SimDuration Share(long units, SimDuration span) =>
        SimDuration.FromTicks(((span.Ticks >> FractionBits) * units) + (((span.Ticks & ((1L << FractionBits) - 1)) * units) >> FractionBits));
}
