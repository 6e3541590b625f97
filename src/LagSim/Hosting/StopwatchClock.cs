using System.Diagnostics;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>This machine's monotonic clock, from zero at construction. The wall clock has no part in it.</summary>
/// <remarks>
/// Immutable, so safe on any thread. It runs for 97 days (less the offset); after that <see cref="Now"/> throws
/// <see cref="System.OverflowException"/>.
/// </remarks>
public sealed class StopwatchClock : IClock
{
    private readonly long started = Stopwatch.GetTimestamp();
    private readonly SimTime origin;

    /// <summary>A clock that starts now.</summary>
    /// <param name="offset">The first reading, default zero: other values stand in for another machine's clock.</param>
    public StopwatchClock(SimDuration offset = default) => origin = SimTime.Zero + offset;

    /// <inheritdoc/>
    public SimTime Now => origin + SimDuration.FromTicks(ToTicks(Stopwatch.GetTimestamp() - started, Stopwatch.Frequency));

    /// <summary>Counts of a frequency below 2^43 Hz as ticks of 2^-40 s, rounded down.</summary>
    /// <exception cref="System.OverflowException">More than 97 days.</exception>
    internal static long ToTicks(long counts, long frequency)
    {
        // The fraction of a second is scaled by 2^20 twice: at once it would not fit.
        long seconds = counts / frequency;
        long fraction = (counts % frequency) << 20;
        long high = fraction / frequency;
        long low = ((fraction % frequency) << 20) / frequency;
        return checked((seconds * SimDuration.TicksPerSecond) + ((high << 20) + low));
    }
}
