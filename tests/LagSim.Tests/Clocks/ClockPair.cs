using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Clocks;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Tests.Clocks;

/// <summary>Two clocks with a link between them, in virtual time: all exchanges by seed, and what an estimate makes of them against the truth.</summary>
internal sealed class ClockPair
{
    internal static readonly SimDuration Ahead = SimDuration.FromSeconds(1.24);

    private static readonly SimDuration SampleStep = SimDuration.FromMilliseconds(50);

    /// <summary>What an update without events has, about.</summary>
    private const int DatagramBytes = 60;

    private readonly List<Stamps> stamps;

    /// <summary>All exchanges of so many seconds.</summary>
    /// <param name="link">Up is from the own clock's peer to the other's.</param>
    /// <param name="drift">How much faster the other clock runs, in parts per million; each clock is off by half of it.</param>
    /// <param name="busy">An exchange every 30 ms, else every 2 s; after 20 ms each in either case, until a world would begin.</param>
    /// <param name="seed">The link's luck.</param>
    /// <param name="seconds">How long requests are sent.</param>
    internal ClockPair(LinkProfile link, double drift, bool busy, ulong seed, double seconds = 120)
    {
        Drift = drift;
        VirtualClock unused = new();
        Own = new SkewedClock(unused, -drift / 2, SimDuration.FromSeconds(7));
        Other = new SkewedClock(unused, drift / 2, SimDuration.FromSeconds(7) + Ahead);
        SeededRandom random = new(seed);
        LinkModel up = new(link.ToHost, random.Fork(1)), down = new(link.FromHost, random.Fork(2));

        // As in a session: the host answers at once, and whoever was overtaken or comes twice does not count.
        List<(SimTime Sent, SimTime Arrived)> asked = [], answered = [];
        foreach (SimTime sent in Schedule(link, busy, seconds))
        {
            Deliver(up, sent, sent, asked);
        }

        foreach ((SimTime sent, SimTime arrived) in InOrder(asked))
        {
            Deliver(down, arrived, sent, answered);
        }

        Dictionary<SimTime, SimTime> there = InOrder(asked).ToDictionary(a => a.Sent, a => a.Arrived);
        stamps = InOrder(answered).Select(a => new Stamps(
            Own.ReadingAt(a.Sent), Other.ReadingAt(there[a.Sent]), Other.ReadingAt(there[a.Sent]), Own.ReadingAt(a.Arrived), a.Arrived)).ToList();
        End = SimTime.FromSeconds(seconds);
    }

    internal double Drift { get; }

    internal SkewedClock Own { get; }

    internal SkewedClock Other { get; }

    internal SimTime End { get; }

    internal IReadOnlyList<Stamps> Exchanges => stamps;

    internal SimDuration TruthAt(SimTime trueTime) => Other.ReadingAt(trueTime) - Own.ReadingAt(trueTime);

    /// <summary>What the estimate says and should say every 50 ms of true time, from when it is ready on and not before a time.</summary>
    internal IEnumerable<Sample> Follow(ClockSync sync, double from = 0)
    {
        int next = 0;
        for (SimTime now = SimTime.Zero; now < End; now += SampleStep)
        {
            for (; next < stamps.Count && stamps[next].TrueBack <= now; next++)
            {
                stamps[next].AddTo(sync);
            }

            if (sync.IsReady && now >= SimTime.FromSeconds(from))
            {
                yield return new Sample(now, Own.ReadingAt(now), TruthAt(now), sync.Estimate);
            }
        }
    }

    /// <summary>Percentiles of the absolute error, in milliseconds.</summary>
    internal static Percentiles Errors(IEnumerable<Sample> samples) => Percentiles.Of(samples.Select(s => Math.Abs(s.Error.ToMilliseconds())));

    private static IEnumerable<SimTime> Schedule(LinkProfile link, bool busy, double seconds)
    {
        double joined = 0.5 + (2 * link.RoundTripMilliseconds / 1000);
        for (double at = 0; at < seconds; at += at < joined ? 0.02 : busy ? 0.03 : 2)
        {
            yield return SimTime.FromSeconds(at);
        }
    }

    private static void Deliver(LinkModel leg, SimTime at, SimTime sent, List<(SimTime Sent, SimTime Arrived)> arrivals)
    {
        LinkDeliveries deliveries = leg.Send(at, DatagramBytes);
        for (int i = 0; i < deliveries.Count; i++)
        {
            arrivals.Add((sent, deliveries[i]));
        }
    }

    private static IEnumerable<(SimTime Sent, SimTime Arrived)> InOrder(List<(SimTime Sent, SimTime Arrived)> arrivals)
    {
        SimTime newest = SimTime.MinValue;
        foreach ((SimTime sent, SimTime arrived) in arrivals.OrderBy(a => a.Arrived).ThenBy(a => a.Sent))
        {
            if (sent > newest)
            {
                newest = sent;
                yield return (sent, arrived);
            }
        }
    }

    /// <summary>The four readings of one exchange, and the true time at which it came back.</summary>
    internal readonly record struct Stamps(SimTime OwnSend, SimTime OtherReceive, SimTime OtherSend, SimTime OwnReceive, SimTime TrueBack)
    {
        internal SimDuration RoundTrip => OwnReceive - OwnSend - (OtherSend - OtherReceive);

        internal void AddTo(ClockSync sync) => Xunit.Assert.True(sync.Add(OwnSend, OtherReceive, OtherSend, OwnReceive));
    }

    /// <summary>An estimate against the truth, at one instant.</summary>
    internal readonly record struct Sample(SimTime TrueTime, SimTime OwnTime, SimDuration Truth, ClockEstimate Estimate)
    {
        internal SimDuration Error => Estimate.OffsetAt(OwnTime) - Truth;

        internal SimDuration Bound => Estimate.ErrorBoundAt(OwnTime);

        internal bool IsWithinBound => Error <= Bound && -Error <= Bound;
    }
}
