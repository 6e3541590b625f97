using System;

namespace LagSim.Time;

/// <summary>The two places where ticks and floating-point seconds meet, each rounding once.</summary>
internal static class TickConversion
{
    /// <summary>2^-40, a power of two: multiplying by it is exact.</summary>
    internal const double SecondsPerTick = 1.0 / SimDuration.TicksPerSecond;

    // 2^63 as a double; every double strictly inside +-2^63 converts to long without overflow.
    private const double TickLimit = 9223372036854775808.0;

    internal static long FromSeconds(double seconds, string parameter)
    {
        if (!TryFromSeconds(seconds, out long ticks))
        {
            throw new ArgumentOutOfRangeException(
                parameter, seconds, "A time must be finite and within 97 days (2^23 s) of zero.");
        }

        return ticks;
    }

    /// <summary>Nearest tick, ties to even; false for what is not finite or does not fit.</summary>
    internal static bool TryFromSeconds(double seconds, out long ticks)
    {
        double scaled = Math.Round(seconds * SimDuration.TicksPerSecond, MidpointRounding.ToEven);
        bool fits = scaled < TickLimit && scaled > -TickLimit; // false for NaN
        ticks = fits ? (long)scaled : 0;
        return fits;
    }
}
