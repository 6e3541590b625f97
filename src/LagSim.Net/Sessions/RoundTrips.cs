using System;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The round trips of one link: how long they take in the mean and at least, and how much of that is waiting in a queue on the way.</summary>
/// <remarks>
/// A queue lengthens all trips, jitter some. So there is one where neither the least of a few trips in succession (the standing queue of CoDel, RFC 8289) nor
/// their smoothed mean comes near the least that each was in the last minute: a few lucky trips say so of the first, and one spike does not lift the second.
/// </remarks>
internal sealed class RoundTrips
{
    /// <summary>A round trip that is said to be longer is none: what the other says of its own times is not checked.</summary>
    private static readonly SimDuration Longest = SimDuration.FromSeconds(10);

    /// <summary>How long the shortest round trip is remembered: a way that has become longer is taken for a queue for no longer than this.</summary>
    private static readonly SimDuration Memory = SimDuration.FromSeconds(60);

    /// <summary>Less than this is no queue: what a sleeping thread, or a radio that waits for its turn, adds to every trip.</summary>
    private static readonly SimDuration LeastQueue = SimDuration.FromMilliseconds(5);

    /// <summary>How many trips are a few.</summary>
    private const int Few = 4;

    private WindowedMinimum least;
    private WindowedMinimum leastMean;
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
    /// After how long an answer can be taken for lost: the mean and four times its mean deviation, as TCP has it. Zero before one <see cref="IsMeasured"/>.
    /// </summary>
    internal SimDuration Patience => Mean + (Deviation * 4);

    /// <summary>How long what is sent now waits in a queue on the way, there or back, as far as the round trips tell.</summary>
    internal SimDuration Queueing => Lesser(LeastOfFew - least.Value, Mean - leastMean.Value);

    /// <summary>
    /// Whether there is a queue on the way: a quarter of the shortest round trip, so that a link that holds back then stays well below twice that one.
    /// </summary>
    internal bool HasQueue => Queueing > LeastQueue && Queueing > least.Value / 4;

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
            Deviation += ((sample < Mean ? Mean - sample : sample - Mean) - Deviation) / 4;
            Mean += (sample - Mean) / 8;
        }

        IsMeasured = true;
        Newest = sample;
        least.Add(sample, now, Memory);
        leastMean.Add(Mean, now, Memory);
        few[next] = sample;
        next = (next + 1) % Few;
    }

    private SimDuration LeastOfFew => Lesser(Lesser(few[0], few[1]), Lesser(few[2], few[3]));

    private static SimDuration Lesser(SimDuration a, SimDuration b) => a < b ? a : b;
}
