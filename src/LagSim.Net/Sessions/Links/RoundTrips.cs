using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>The round trips of one link: their mean and minimum, and how much of them is waiting in a queue.</summary>
/// <remarks>
/// A queue lengthens all trips, jitter some. So a queue is assumed if neither the minimum of a few consecutive trips (the standing queue of
/// CoDel, RFC 8289) nor their smoothed mean comes near the least value that each had in the last minute: a few lucky trips clear the first,
/// and one spike does not raise the second. Near is what the link's jitter accounts for, taken where it is least, since a queue that comes
/// and goes is not jitter.
/// </remarks>
internal sealed class RoundTrips
{
    /// <summary>
    /// The longest accepted round trip; a longer one is discarded, since the other peer's own times are not verified. A queue of 2 s that is
    /// emptied at a fifth of its rate, in both directions, takes 20 s: a link that did not count such a trip would see no queue.
    /// </summary>
    private static readonly SimDuration Longest = SimDuration.FromSeconds(60);

    /// <summary>
    /// How long the shortest round trip is remembered, and so how long a path that has become longer can be taken for a queue.
    /// </summary>
    private static readonly SimDuration Memory = SimDuration.FromSeconds(60);

    /// <summary>
    /// The least delay that counts as a queue. A sleeping thread, or a radio that waits for its turn, adds less to every trip.
    /// </summary>
    private static readonly SimDuration MinQueue = SimDuration.FromMilliseconds(5);

    /// <summary>How many times the least spread of a minute jitter moves the mean from its minimum.</summary>
    /// <remarks>
    /// A mean smoothed by an eighth has 0.26 of the jitter's standard deviation; in a minute it moves over six of its own, 1.5; and the
    /// spread of sixteen trips is at its least some 0.4. A larger value detects a new queue later.
    /// </remarks>
    private const int SpreadFactor = 4;

    /// <summary>The number of trips over which the spread is measured; with fewer, it is unknown.</summary>
    private const int Many = 16;

    /// <summary>The number of trips that count as a few.</summary>
    private const int Few = 4;

    private WindowedMinimum least;
    private WindowedMinimum minMean;
    private WindowedMinimum minSpread;
    private SimDuration spread; // the mean deviation, over more trips than the timeout uses
    private int counted; // the number of trips so far, up to Many
    private readonly SimDuration[] few = new SimDuration[Few]; // the newest
    private int next;

    /// <summary>Whether a round trip has been measured yet.</summary>
    internal bool IsMeasured { get; private set; }

    /// <summary>The newest round trip; zero before there is one.</summary>
    internal SimDuration Newest { get; private set; }

    /// <summary>The shortest of the last minute; zero before there is one.</summary>
    internal SimDuration Least => least.Value;

    /// <summary>The smoothed mean, as in TCP (RFC 6298).</summary>
    internal SimDuration Mean { get; private set; }

    /// <summary>The mean deviation from the mean, as in TCP.</summary>
    internal SimDuration Deviation { get; private set; }

    /// <summary>
    /// The time after which an answer counts as lost: the mean and four times the mean deviation, as in TCP. Zero until one
    /// <see cref="IsMeasured"/>.
    /// </summary>
    internal SimDuration Timeout => Mean + (Deviation * 4);

    /// <summary>How long a datagram sent now waits in a queue, there or back, as far as the round trips show.</summary>
    internal SimDuration Queueing => Lesser(LeastOfFew - least.Value, Mean - minMean.Value);

    /// <summary>Whether there is a queue on the path: more than a quarter of the shortest round trip, and more than jitter.</summary>
    /// <remarks>
    /// A link that holds back at that point stays well below twice the shortest round trip. Delay that doubles the shortest round trip is a
    /// queue whatever the jitter: a peer that joins while a queue rises and falls knows no other spread.
    /// </remarks>
    internal bool HasQueue =>
        Queueing > MinQueue && Queueing > least.Value / 4 && Queueing > Lesser(minSpread.Value * SpreadFactor, least.Value);

    internal void Add(SimDuration sample, SimTime now)
    {
        if (sample > Longest || sample < SimDuration.Zero)
        {
            return;
        }

        if (!IsMeasured)
        {
            Mean = sample;
            Array.Fill(few, sample);
            Deviation = sample / 2;
        }
        else
        {
            SimDuration apart = sample < Mean ? Mean - sample : sample - Mean;
            Deviation += (apart - Deviation) / 4;
            counted = Math.Min(counted + 1, Many);
            spread += (apart - spread) / counted;
            Mean += (sample - Mean) / 8;
        }

        IsMeasured = true;
        Newest = sample;
        least.Add(sample, now, Memory);
        minMean.Add(Mean, now, Memory);
        if (counted == Many)
        {
            minSpread.Add(spread, now, Memory);
        }

        few[next] = sample;
        next = (next + 1) % Few;
    }

    private SimDuration LeastOfFew => Lesser(Lesser(few[0], few[1]), Lesser(few[2], few[3]));

    private static SimDuration Lesser(SimDuration a, SimDuration b) => a < b ? a : b;
}
