using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A token bucket: tokens come in at a rate, up to a burst, and datagrams take them when they leave. Exact: whole numbers, rounded up to a
/// tick once per datagram.
/// </summary>
/// <remarks>Begins full. A token is the 2^-40th part of a bit: what a rate of one bit per second adds in a tick. Not thread-safe.</remarks>
internal sealed class TokenBucket
{
    private const long TokensPerByte = 8 * SimDuration.TicksPerSecond;

    private readonly long rate;
    private readonly PeriodicDip? dip;
    private readonly Cadence dips;
    private readonly long room; // 0: a line without a bucket
    private SimTime filled = SimTime.MinValue; // the time up to which tokens have been added
    private long tokens;

    /// <param name="bottleneck">Its rates and burst.</param>
    /// <param name="phase">The fraction of a dip's period 0 that has elapsed at time zero, 0 to below 1.</param>
    internal TokenBucket(Bottleneck bottleneck, double phase)
    {
        rate = bottleneck.RateBitsPerSecond;
        dip = bottleneck.Dip;
        dips = dip is null ? default : new Cadence(dip.Period, phase);
        room = bottleneck.BurstBytes * TokensPerByte;
        tokens = room;
    }

    /// <summary>Takes a datagram's tokens as soon as there are enough.</summary>
    /// <param name="from">Not earlier than any time given or returned before.</param>
    /// <param name="bytes">Its bytes on the wire; at most the burst, if there is one.</param>
    /// <returns>When there are enough; not before <paramref name="from"/>.</returns>
    internal SimTime Take(SimTime from, int bytes)
    {
        long need = bytes * TokensPerByte;
        if (room == 0)
        {
            tokens = 0;
            filled = from;
        }
        else
        {
            FillUntil(from);
        }

        while (true)
        {
            long now = RateAt(filled, out SimDuration lasts);
            long missing = need - tokens;
            if (missing <= 0)
            {
                break;
            }

            long wait = ((missing - 1) / now) + 1;
            long step = Math.Min(wait, lasts.Ticks);
            tokens += step * now; // below need + rate
            filled += SimDuration.FromTicks(step);
        }

        tokens -= need;
        return filled;
    }

    private void FillUntil(SimTime time)
    {
        while (filled < time && tokens < room)
        {
            long now = RateAt(filled, out SimDuration lasts);
            long step = Math.Min((time - filled).Ticks, lasts.Ticks);
            tokens = step > (room - tokens) / now ? room : tokens + (step * now);
            filled += SimDuration.FromTicks(step);
        }

        tokens = Math.Min(tokens, room);
        filled = time;
    }

    /// <summary>Whether the rate is that of a dip at a time.</summary>
    internal bool IsInDip(SimTime time)
    {
        if (dip is null)
        {
            return false;
        }

        dips.At(time, out SimDuration into);
        return into < dip.Length;
    }

    /// <summary>The rate from a time on, and how long it stays.</summary>
    private long RateAt(SimTime time, out SimDuration lasts)
    {
        if (dip is null)
        {
            lasts = SimDuration.MaxValue;
            return rate;
        }

        dips.At(time, out SimDuration into);
        bool isIn = into < dip.Length;
        lasts = (isIn ? dip.Length : dip.Period) - into;
        return isIn ? dip.RateBitsPerSecond : rate;
    }
}
