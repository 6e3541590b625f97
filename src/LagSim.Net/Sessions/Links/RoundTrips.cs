using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// The round trips of one link: how long they take in the mean and at least, and how much of that is waiting in a queue on the way.
/// </summary>
/// <remarks>
///  A queue lengthens all trips, jitter some. So there is one where neither the least of a few trips in succession (the standing queue of
/// CoDel, RFC 8289) nor their smoothed mean comes near the least that each was in the last minute: a few lucky trips say so of the first,
/// and one spike does not lift the second. Near is what the jitter of the link accounts for, as it is where it is least: a queue that comes
/// and goes is none.
/// </remarks>
internal sealed class RoundTrips
{
    /// <summary>A round trip that is said to be longer is none: what the other says of its own times is not checked.</summary>
    private static readonly SimDuration Longest = SimDuration.FromSeconds(10);

    /// <summary>
    /// How long the shortest round trip is remembered: a way that has become longer is taken for a queue for no longer than this.
    /// </summary>
    private static readonly SimDuration Memory = SimDuration.FromSeconds(60);

    /// <summary>Less than this is no queue: what a sleeping thread, or a radio that waits for its turn, adds to every trip.</summary>
    private static readonly SimDuration LeastQueue = SimDuration.FromMilliseconds(5);

    /// <summary>
    ///  How many times the least spread of a minute jitter moves the mean from its least. A mean smoothed by an eighth has 0.26 of the
    /// jitter's standard deviation; in a minute it goes over six of its own, 1.5; and the spread of sixteen trips is at its least some 0.4.
    /// More takes longer to see a queue that comes.
    /// </summary>
    private const int MostOfSpread = 4;

    /// <summary>Over so many trips the spread is taken; before there are so many, nothing is known of it.</summary>
    private const int Many = 16;

    /// <summary>How many trips are a few.</summary>
    private const int Few = 4;

    private WindowedMinimum least;
    private WindowedMinimum leastMean;
    private WindowedMinimum leastSpread;
    private SimDuration spread; // the mean deviation, over more trips than the one that answers are waited for by
    private int counted; // how many trips there were, up to many
    private readonly SimDuration[] few = new SimDuration[Few]; // the newest
    private int next;

    /// <summary>Whether one has been measured yet.</summary>
    internal bool IsMeasured { get; private set; }

    /// <summary>The newest; zero before there is one.</summary>
    internal SimDuration Newest { get; private set; }

    /// <summary>The mean, as TCP has it (RFC 6298).</summary>
    internal SimDuration Mean { get; private set; }

    /// <summary>The mean deviation from the mean, likewise.</summary>
    internal SimDuration Deviation { get; private set; }

    /// <summary>
    ///  After how long an answer can be taken for lost: the mean and four times its mean deviation, as TCP has it. Zero before one
    /// <see cref="IsMeasured"/>.
    /// </summary>
    internal SimDuration Timeout => Mean + (Deviation * 4);

    /// <summary>How long what is sent now waits in a queue on the way, there or back, as far as the round trips tell.</summary>
    internal SimDuration Queueing => Lesser(LeastOfFew - least.Value, Mean - leastMean.Value);

    /// <summary>
    ///  Whether there is a queue on the way: a quarter of the shortest round trip, so that a link that holds back then stays well below
    /// twice that one, and more than jitter. What doubles the shortest is one whatever the jitter: who comes in while a queue goes up and
    /// down knows no other spread.
    /// </summary>
    internal bool HasQueue => Queueing > LeastQueue && Queueing > least.Value / 4 && Queueing > Lesser(leastSpread.Value * MostOfSpread, least.Value);

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
        leastMean.Add(Mean, now, Memory);
        if (counted == Many)
        {
            leastSpread.Add(spread, now, Memory);
        }

        few[next] = sample;
        next = (next + 1) % Few;
    }

    private SimDuration LeastOfFew => Lesser(Lesser(few[0], few[1]), Lesser(few[2], few[3]));

    private static SimDuration Lesser(SimDuration a, SimDuration b) => a < b ? a : b;
}
