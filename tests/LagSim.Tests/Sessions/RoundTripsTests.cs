using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Links;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>
/// What round trips say of a link: their mean by the book, and a queue where there is one, but not where there is only jitter.
/// </summary>
public sealed class RoundTripsTests(ITestOutputHelper output)
{
    private static readonly SimDuration Pause = SimDuration.FromMilliseconds(30);

    [Fact]
    public void Mean_Deviation_AndTimeout_AreThoseOfTcp()
    {
        for (int seed = 0; seed < 40; seed++)
        {
            Random random = new(seed);
            RoundTrips trips = new();
            double mean = 0, deviation = 0;
            bool isFirst = true;
            SimTime now = SimTime.FromSeconds(1);
            for (int n = 0; n < 300; n++)
            {
                now += Pause;
                double sample = random.Next(30) == 0 ? random.Next(2) == 0 ? -0.001 : 60.1 : random.NextDouble() * 0.5;
                trips.Add(SimDuration.FromSeconds(sample), now);
                if (sample is >= 0 and <= 60)
                {
                    deviation = isFirst ? sample / 2 : deviation + ((Math.Abs(sample - mean) - deviation) / 4); // RFC 6298, 2.2 and 2.3
                    mean = isFirst ? sample : mean + ((sample - mean) / 8);
                    isFirst = false;
                    Assert.Equal(sample, trips.Newest.ToSeconds(), 1e-8);
                }

                Assert.Equal(!isFirst, trips.IsMeasured);
                Assert.Equal(mean, trips.Mean.ToSeconds(), 1e-8);
                Assert.Equal(deviation, trips.Deviation.ToSeconds(), 1e-8);
                Assert.Equal(mean + (4 * deviation), trips.Timeout.ToSeconds(), 1e-8);
            }
        }
    }

    [Fact]
    public void Queueing_IsNeitherBelowNothing_NorMoreThanTheTripsHaveGrown()
    {
        for (int seed = 0; seed < 40; seed++)
        {
            Random random = new(seed);
            RoundTrips trips = new();
            SimTime now = SimTime.FromSeconds(1);
            List<SimDuration> all = [];
            for (int n = 0; n < 1000; n++)
            {
                now += Pause;
                all.Add(SimDuration.FromMilliseconds(20 + random.Next(1 + (n / 10))));
                trips.Add(all[^1], now);
                Assert.InRange(trips.Queueing.Ticks, 0, all.TakeLast(4).Min(s => s.Ticks) - all.Min(s => s.Ticks));
            }
        }
    }

    /// <summary>The harness's links draw their jitter for each datagram; a queue adds to all of them.</summary>
    [Theory]
    [InlineData(45, 15, 0.05)]
    [InlineData(45, 20, 0.35)] // such jitter doubles the shortest trip
    [InlineData(100, 20, 0.1)]
    [InlineData(125, 50, 0.35)]
    [InlineData(200, 60, 0.35)]
    public void HasQueue_UnderPlainJitter_IsRare_AndUnderAQueueTheRule(double delay, double jitter, double most)
    {
        double falsely = Share(new LinkLeg(delay, jitter), queue: 0);
        double truly = Share(new LinkLeg(delay, jitter), queue: 2 * delay);
        output.WriteLine(
            $"{delay} ms, jitter {jitter} ms: a queue shows after {falsely:P2} of the trips without one, {truly:P2} with one of {2 * delay} ms");
        Assert.InRange(falsely, 0, most);
        Assert.InRange(truly, 0.9, 1);
    }

    /// <summary>
    /// After how many of the trips of half a minute a queue shows, once the link is known; half a minute is one in which it comes.
    /// </summary>
    private static double Share(LinkLeg leg, double queue)
    {
        const int known = 600, looked = 1000, seeds = 20;
        int shown = 0;
        for (ulong seed = 1; seed <= seeds; seed++)
        {
            LinkModel there = new(leg, new SeededRandom(seed)), back = new(leg, new SeededRandom(seed + 1000));
            RoundTrips trips = new();
            SimTime sent = SimTime.FromSeconds(1);
            List<(SimTime Sent, SimTime Back)> all = [];
            for (int n = 0; n < known + looked; n++)
            {
                sent += Pause;
                SimTime arrived = there.Send(sent, 100)[0];
                all.Add((sent, back.Send(arrived, 100)[0] + (n >= known ? SimDuration.FromMilliseconds(queue) : SimDuration.Zero)));
            }

            for (int n = 0; n < all.Count; n++)
            {
                trips.Add(all[n].Back - all[n].Sent, all[n].Back);
                shown += n >= known + 20 && trips.HasQueue ? 1 : 0;
            }
        }

        return shown / (double)(seeds * (looked - 20));
    }
}
