using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>Divides time into numbered periods of equal length; whole ticks, so exact at any time and on any machine.</summary>
internal readonly struct Cadence
{
    internal const double MinSeconds = 0.001;
    internal const double MaxSeconds = 86_400;

    private readonly long period;
    private readonly long lead;

    /// <param name="period">The length of a period.</param>
    /// <param name="phase">The fraction of period 0 that has elapsed at time zero, 0 to below 1.</param>
    internal Cadence(SimDuration period, double phase)
    {
        this.period = period.Ticks;
        lead = (long)(phase * period.Ticks);
    }

    /// <summary>Returns the period that a time lies in.</summary>
    /// <param name="time">Any time.</param>
    /// <param name="into">How much of that period has elapsed by then.</param>
    internal long At(SimTime time, out SimDuration into)
    {
        (long number, long rest) = Math.DivRem(time.Ticks, period);
        rest += rest < 0 ? lead + period : lead; // below two periods, so nothing overflows
        number -= time.Ticks % period < 0 ? 1 : 0;
        bool next = rest >= period;
        into = SimDuration.FromTicks(next ? rest - period : rest);
        return next ? number + 1 : number;
    }

    internal static SimDuration Period(double seconds, string parameter) =>
        seconds is >= MinSeconds and <= MaxSeconds
            ? SimDuration.FromSeconds(seconds)
            : throw new ArgumentOutOfRangeException(parameter, seconds, $"A period is {MinSeconds} to {MaxSeconds} s.");
}
