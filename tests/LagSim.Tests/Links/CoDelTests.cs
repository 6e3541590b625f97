using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class CoDelTests
{
    private static readonly Bottleneck Controlled = new(1_000_000, 1_000, QueueDiscipline.CoDel);

    [Theory]
    [InlineData(1, 1_000_000, 0)]
    [InlineData(2, 1_000_000, 1_540)]
    [InlineData(3, 256_000, 0)]
    [InlineData(4, 10_000_000, 1_540)]
    public void Send_AnyLoad_LosesExactlyWhatThePseudocodeLoses(ulong seed, long rate, int burst)
    {
        Bottleneck bottleneck = new(rate, 10_000, QueueDiscipline.CoDel) { BurstBytes = burst };
        (SimTime At, int Bytes)[] sent = Load(seed, rate, 20_000);
        SimTime?[] got = Fates(bottleneck, sent), said = Pseudocode(bottleneck, sent);
        Assert.InRange(got.Count(leaves => leaves is null), 200, 15_000);
        Assert.Equal(said, got);

        // Negative control: the comparison sees what is lost otherwise.
        Assert.NotEqual(said, Fates(new Bottleneck(rate, 10_000), sent));
    }

    [Fact]
    public void Send_SteadyOverload_KeepsTheWaitFarBelowDropTails()
    {
        (SimTime At, int Bytes)[] sent = [.. Enumerable.Range(0, 20_000).Select(i => (SimTime.FromSeconds(0.0098 * i), 1_200))]; // 1.4 % more than the rate
        double[] codel = Waits(Controlled, sent), tail = Waits(new Bottleneck(1_000_000, 1_000), sent);
        Assert.InRange(codel.Percentile(50), 0, 100);
        Assert.InRange(tail.Percentile(50), 700, 1_020);
    }

    [Fact]
    public void Send_LessThanTheRate_LosesNothing()
    {
        (SimTime At, int Bytes)[] sent = [.. Enumerable.Range(0, 5_000).Select(i => (SimTime.FromSeconds(0.011 * i), 1_200))];
        Assert.DoesNotContain(null, Fates(Controlled, sent));
    }

    [Fact]
    public void Send_AskedForAnAnswerAtOnce_IsRefused()
    {
        LinkModel link = new(new LinkLeg(1) { Bottleneck = Controlled }, new SeededRandom(1));
        Assert.False(link.DecidesAtOnce);
        Assert.Contains("CoDel", Assert.Throws<InvalidOperationException>(() => link.Send(SimTime.Zero, 1)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void DeliverUntil_QueueOfCoDel_DeliversWhatTheLinkModelSays()
    {
        (SimTime At, int Bytes)[] sent = [.. Enumerable.Range(0, 2_000).Select(i => (SimTime.FromSeconds(0.005 * i), 1_000))];
        SimTime?[] expected = Fates(Controlled, sent);

        VirtualClock clock = new();
        VirtualNetwork network = new(clock, 1);
        IDatagramPort from = network.CreatePort(1), to = network.CreatePort(0);
        network.SetLink(1, 0, new LinkLeg(0) { Bottleneck = Controlled });
        List<SimTime> arrived = [];
        to.Arrived += () => arrived.Add(clock.Now);
        byte[] datagram = new byte[1_000];
        foreach ((SimTime at, _) in sent)
        {
            while (network.NextDelivery <= at)
            {
                network.DeliverUntil(network.NextDelivery.Value);
            }

            network.DeliverUntil(at);
            from.Send(datagram, to.LocalAddress);
        }

        network.SetLink(1, 0, new LinkLeg(0)); // what waits in a queue that nobody else enters still arrives
        network.DeliverUntil(SimTime.FromSeconds(100));
        Assert.Null(network.NextDelivery);
        Assert.Equal(expected.Where(leaves => leaves is not null).Select(leaves => leaves!.Value), arrived);
        Assert.Equal(expected.Count(leaves => leaves is null), network.DatagramsLost);
    }

    private static SimTime?[] Fates(Bottleneck bottleneck, (SimTime At, int Bytes)[] sent)
    {
        LinkModel link = new(new LinkLeg(0) { Bottleneck = bottleneck }, new SeededRandom(1));
        SimTime?[] fates = new SimTime?[sent.Length];
        int told = 0;
        for (int i = 0; i < sent.Length; i++)
        {
            int number = i;
            link.Send(sent[i].At, sent[i].Bytes, deliveries =>
            {
                fates[number] = deliveries.Count == 1 ? deliveries[0] : null;
                told++;
            });
        }

        link.Queue!.DecideUntil(SimTime.FromSeconds(1_000_000));
        Assert.Equal(sent.Length, told);
        Assert.Null(link.Queue.NextDecision);
        return fates;
    }

    private static double[] Waits(Bottleneck bottleneck, (SimTime At, int Bytes)[] sent) =>
        [.. Fates(bottleneck, sent).Zip(sent).Skip(sent.Length / 2).Where(pair => pair.First is not null).Select(pair => (pair.First!.Value - pair.Second.At).ToMilliseconds())];

    /// <summary>A load that goes above the rate and below it for seconds at a time.</summary>
    private static (SimTime At, int Bytes)[] Load(ulong seed, long rate, int datagrams)
    {
        SeededRandom random = new(seed);
        var sent = new (SimTime, int)[datagrams];
        double at = 0, load = 1;
        for (int i = 0; i < datagrams; i++)
        {
            load = i % 500 == 0 ? random.NextDouble(0.3, 1.8) : load;
            int bytes = (int)random.NextDouble(20, 1_400);
            at += random.NextDouble(0, 2) * bytes * 8 / (rate * load);
            sent[i] = (SimTime.FromSeconds(at), bytes);
        }

        return sent;
    }

    /// <summary>RFC 8289, section 5, word for word, over a list; drawn up for this test and no part of the product.</summary>
    private static SimTime?[] Pseudocode(Bottleneck bottleneck, (SimTime At, int Bytes)[] sent)
    {
        SimDuration target = SimDuration.FromMilliseconds(5), interval = SimDuration.FromMilliseconds(100);
        SimTime?[] fates = new SimTime?[sent.Length];
        Queue<int> queue = [];
        TokenBucket bucket = new(bottleneck, 0);
        int arrived = 0;
        SimTime? firstAboveTime = null;
        SimTime dropNext = default;
        uint count = 0, lastcount = 0;
        bool dropping = false;

        (int? P, bool OkToDrop) DoDequeue(SimTime now)
        {
            if (!queue.TryDequeue(out int p))
            {
                firstAboveTime = null;
                return (null, false);
            }

            if (now - sent[p].At < target || queue.Sum(i => sent[i].Bytes + Bottleneck.OverheadBytes) <= 1_514)
            {
                firstAboveTime = null;
            }
            else if (firstAboveTime is null)
            {
                firstAboveTime = now + interval;
            }
            else if (now >= firstAboveTime)
            {
                return (p, true);
            }

            return (p, false);
        }

        int? Dequeue(SimTime now)
        {
            (int? P, bool OkToDrop) r = DoDequeue(now);
            if (dropping)
            {
                if (!r.OkToDrop)
                {
                    dropping = false;
                }

                while (now >= dropNext && dropping)
                {
                    ++count; // and r.P stays without a time: dropped
                    r = DoDequeue(now);
                    if (!r.OkToDrop)
                    {
                        dropping = false;
                    }
                    else
                    {
                        dropNext += SimDuration.FromTicks((long)(interval.Ticks / Math.Sqrt(count)));
                    }
                }
            }
            else if (r.OkToDrop)
            {
                r = DoDequeue(now);
                dropping = true;
                uint delta = count - lastcount;
                count = 1;
                if (delta > 1 && now - dropNext < interval * 16)
                {
                    count = delta;
                }

                dropNext = now + SimDuration.FromTicks((long)(interval.Ticks / Math.Sqrt(count)));
                lastcount = count;
            }

            return r.P;
        }

        for (SimTime free = SimTime.MinValue; arrived < sent.Length || queue.Count > 0;)
        {
            for (; arrived < sent.Length && sent[arrived].At < free; arrived++)
            {
                queue.Enqueue(arrived);
            }

            if (Dequeue(free == SimTime.MinValue ? sent[0].At : free) is int next)
            {
                free = bucket.Take(free, sent[next].Bytes + Bottleneck.OverheadBytes);
                fates[next] = free;
            }
            else if (arrived < sent.Length)
            {
                free = sent[arrived].At;
                queue.Enqueue(arrived++);
            }
        }

        return fates;
    }
}
