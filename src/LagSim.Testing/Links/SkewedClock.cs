using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>The clock of a machine that runs wrong: true time x (1 + skew) + offset.</summary>
/// <remarks>
/// Exact to a tick, rounded down; never goes back. Deterministic: integers only. As safe on any thread as the clock it wraps.
/// </remarks>
internal sealed class SkewedClock : IClock
{
    /// <summary>The largest skew either way, in parts per million: a tenth.</summary>
    public const double MaxPartsPerMillion = 100_000;

    private const int FractionBits = 40;
    private readonly IClock trueClock;
    private readonly long skew; // in units of 2^-40, about one part in 10^12

    /// <summary>Creates a clock that deviates from another.</summary>
    /// <param name="trueClock">The clock it deviates from.</param>
    /// <param name="partsPerMillion">How much faster it runs; real crystals are within 100 either way.</param>
    /// <param name="offset">Its reading when <paramref name="trueClock"/> reads zero.</param>
    /// <exception cref="ArgumentOutOfRangeException">
    /// <paramref name="partsPerMillion"/> is not finite or beyond <see cref="MaxPartsPerMillion"/>.
    /// </exception>
    public SkewedClock(IClock trueClock, double partsPerMillion, SimDuration offset)
    {
        ArgumentNullException.ThrowIfNull(trueClock);
        if (!(Math.Abs(partsPerMillion) <= MaxPartsPerMillion))
        {
            throw new ArgumentOutOfRangeException(
                nameof(partsPerMillion), partsPerMillion, $"A clock's skew is within {MaxPartsPerMillion} parts per million either way.");
        }

        this.trueClock = trueClock;
        skew = (long)Math.Round(partsPerMillion * 1e-6 * (1L << FractionBits));
        Offset = offset;
    }

    /// <summary>The reading of this clock when the true one reads zero.</summary>
    public SimDuration Offset { get; }

    /// <inheritdoc/>
    public SimTime Now => ReadingAt(trueClock.Now);

    /// <summary>The reading of this clock at that true time.</summary>
    /// <exception cref="OverflowException">The reading is out of range.</exception>
    public SimTime ReadingAt(SimTime trueTime) => SimTime.FromTicks(checked((long)Reading(trueTime.Ticks)));

    /// <summary>
    /// The first true time at which this clock reads <paramref name="reading"/> or later: when to wake a thread that waits by this clock.
    /// </summary>
    /// <exception cref="OverflowException">The true time is out of range.</exception>
    public SimTime TrueTimeOf(SimTime reading)
    {
        // The quotient is off by at most a few ticks, since the skew is small and the reading rounded once.
        Int128 guess = (((Int128)reading.Ticks - Offset.Ticks) << FractionBits) / (((Int128)1 << FractionBits) + skew);
        while (Reading(guess) >= reading.Ticks)
        {
            guess--;
        }

        while (Reading(guess) < reading.Ticks)
        {
            guess++;
        }

        return SimTime.FromTicks(checked((long)guess));
    }

    private Int128 Reading(Int128 trueTicks) => trueTicks + ((trueTicks * skew) >> FractionBits) + Offset.Ticks;
}
