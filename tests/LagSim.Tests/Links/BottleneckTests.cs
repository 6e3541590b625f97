using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>A rate and a queue of drop-tail; <see cref="KernelBottleneckTests"/> holds them against the kernel's.</summary>
public sealed class BottleneckTests
{
    /// <summary>1,250 bytes on the wire: 10,000 bits.</summary>
    private const int Bytes = 1250 - Bottleneck.OverheadBytes;

    private static readonly SimDuration TenthOfASecond = SimDuration.FromMilliseconds(100);

    private readonly Bottleneck narrow = new(100_000, 1_000); // 14,040 bytes of room; a datagram takes 100 ms

    [Fact]
    public void Send_OneAfterASilence_IsThereAtOnceAndTheNextWhenItsTokensAre()
    {
        LinkModel link = Link(narrow);
        Assert.Equal(At(5), link.Send(At(5), Bytes)[0]);

        // Of 1,540 bytes' tokens 290 are left, so 960 are missing: 76.8 ms.
        SimTime next = link.Send(At(5), Bytes)[0];
        Assert.InRange((next - At(5.0768)).Ticks, 0, 10);
        Assert.InRange((link.Send(At(5), Bytes)[0] - (next + TenthOfASecond)).Ticks, -10, 1);
    }

    [Fact]
    public void Send_LineWithoutABurst_TakesTheTimeOfItsBits()
    {
        LinkModel link = Link(new Bottleneck(100_000, 1_000) { BurstBytes = 0 });
        Assert.InRange((link.Send(At(5), Bytes)[0] - At(5.1)).Ticks, 0, 10);
        Assert.InRange((link.Send(At(5.15), Bytes)[0] - At(5.25)).Ticks, 0, 10);
        Assert.InRange((link.Send(At(5.15), 8)[0] - At(5.254)).Ticks, 0, 10);
    }

    [Theory]
    [InlineData(100_000, 1_000)]
    [InlineData(64_000, 500)]
    [InlineData(10_000_000, 20)]
    public void Send_TwiceTheRate_GetsTheRateThroughAndLosesTheRest(long rate, double queue)
    {
        const int Datagrams = 5_000;
        Bottleneck bottleneck = new(rate, queue);
        (SimTime At, LinkDeliveries Arrives)[] run = Run(bottleneck, SimDuration.FromSeconds(5_000.0 / rate), Datagrams);
        SimTime[] arrivals = run.Where(sent => sent.Arrives.Count > 0).Select(sent => sent.Arrives[0]).ToArray();
        double bits = (arrivals.Length - 1) * 10_000.0;
        Bounds.Near(rate, bits / (arrivals[^1] - arrivals[0]).ToSeconds(), rate * 1e-3);

        // What is in the queue at the end is not lost; all else beyond the rate is.
        int room = (int)(bottleneck.LimitBytes / 1250);
        Assert.InRange(arrivals.Length, Datagrams / 2, (Datagrams / 2) + room + 2);

        // A queue that stands full holds its room's time.
        double[] delays = LinkRun.Delays(run)[^100..];
        Bounds.Near(room * 10_000.0 / rate * 1_000, delays.Max(), 1.01 * 10_000_000.0 / rate);
    }

    [Fact]
    public void Send_BelowTheRate_LosesNothingAndWaitsForNobody()
    {
        // Negative control of the one above.
        (SimTime At, LinkDeliveries Arrives)[] run = Run(narrow, SimDuration.FromMilliseconds(101), 1_000);
        Assert.All(run, sent => Assert.Equal(sent.At, Assert.Single(Arrivals(sent.Arrives))));
    }

    [Fact]
    public void Send_AllAtOnce_HasRoomForExactlyTheLimit()
    {
        // 14,040 bytes: one leaves at once, eleven of 1,250 wait, and then there is room for 290 more.
        LinkModel link = Link(narrow);
        Assert.Equal(14_040, narrow.LimitBytes);
        Assert.Equal(12, Enumerable.Range(0, 100).Count(_ => link.Send(At(1), Bytes).Count == 1));
        Assert.Equal(13_750, link.Queue!.BytesAt(At(1)));
        Assert.Equal(0, link.Send(At(1), 291 - Bottleneck.OverheadBytes).Count);
        Assert.Equal(1, link.Send(At(1), 290 - Bottleneck.OverheadBytes).Count);
        Assert.Equal((13, 89), (link.Queue.Passed, link.Queue.Dropped));
        Assert.Equal(0, link.Queue.BytesAt(At(3)));
    }

    [Fact]
    public void Send_LongerThanTheBurst_NeverGetsThrough()
    {
        LinkModel link = Link(narrow);
        Assert.Equal(1, link.Send(At(1), Bottleneck.DefaultBurstBytes - Bottleneck.OverheadBytes).Count);
        Assert.Equal(0, link.Send(At(9), Bottleneck.DefaultBurstBytes - Bottleneck.OverheadBytes + 1).Count);
        Assert.Equal(1, Link(new Bottleneck(100_000, 1_000) { BurstBytes = 2_000 }).Send(At(9), 1_900).Count);
    }

    [Fact]
    public void Send_RateThatChangesInTheMiddleOfADatagram_TakesEachBitAtItsRate()
    {
        // 10 s of 100 kbit/s, then 10 s of 50; the line has no burst, so that all is plain. From 19.95 s on, half at 50 and half at 100.
        Bottleneck dips = new(100_000, 1_000) { BurstBytes = 0, Dip = new PeriodicDip(20, 10, 50_000) };
        LinkModel link = new(new LinkLeg(0) { Bottleneck = dips }, new SeededRandom(1), null, new LinkQueue(dips));
        Assert.InRange((link.Send(At(5), Bytes)[0] - At(5.2)).Ticks, 0, 20);
        Assert.InRange((link.Send(At(9.9), Bytes)[0] - At(10.05)).Ticks, 0, 20);
        Assert.InRange((link.Send(At(15), Bytes)[0] - At(15.1)).Ticks, 0, 20);
        Assert.InRange((link.Send(At(19.95), Bytes)[0] - At(20.1)).Ticks, 0, 20);

        // Tokens too come in at the rate of their time: 290 are left at 29.9 s, at 30.1 s 290 + 625 + 1,250.
        Bottleneck bucket = new(100_000, 1_000) { BurstBytes = 5_000, Dip = dips.Dip };
        LinkModel other = new(new LinkLeg(0), new SeededRandom(1), null, new LinkQueue(bucket));
        other.Send(At(29.9), 4_710 - Bottleneck.OverheadBytes);
        Assert.Equal(At(30.1), other.Send(At(30.1), 2_164 - Bottleneck.OverheadBytes)[0]);
        Assert.InRange((other.Send(At(30.1), 101 - Bottleneck.OverheadBytes)[0] - At(30.108)).Ticks, -20, 20);
    }

    [Fact]
    public void Send_DipProfile_IsSlowFiveSecondsInThirtyBothWaysAtOnce()
    {
        // 200 kbit/s: in a dip 500 kbit gather, which then take another 1.6 s to drain.
        SeededRandom path = new(7);
        double[] Waits(Bottleneck bottleneck, ulong seed) => LinkRun.Delays(Run(
            new LinkModel(new LinkLeg(0) { Bottleneck = bottleneck }, new SeededRandom(seed), path), SimDuration.FromMilliseconds(50), 12_000));
        Bottleneck dips = LinkProfiles.Dip.ToHost.Bottleneck!;
        double[] up = Waits(dips, 1), down = Waits(LinkProfiles.Dip.FromHost.Bottleneck!, 2);
        Assert.Equal(up, down);
        Assert.Equal(12_000, up.Length);
        Bounds.Near(6.6 / 30, up.Count(wait => wait > 0) / 12_000.0, 0.01);
        Bounds.Near(2_500, up.Max(), 100);

        // Controls: another path dips at another time, and a line without dips does not.
        path = new SeededRandom(8);
        Assert.NotEqual(up, Waits(dips, 1));
        Assert.Equal(0, Waits(new Bottleneck(512_000, 1_000), 1).Max());
    }

    [Fact]
    public void Send_LegsThatShareAQueue_HaveTheRateTogether()
    {
        Bottleneck bottleneck = new(100_000, 200);
        int Got(bool share)
        {
            LinkQueue? queue = share ? new LinkQueue(bottleneck) : null;
            LinkModel[] links = [.. Enumerable.Range(0, 2).Select(i => new LinkModel(new LinkLeg(10) { Bottleneck = bottleneck }, new SeededRandom((ulong)i), null, queue))];
            int[] got = [0, 0];
            for (int i = 0; i < 1_000; i++)
            {
                int of = i % 7 < 3 ? 0 : 1;
                got[of] += links[of].Send(SimTime.FromSeconds(0.05 * i), Bytes).Count;
            }

            Assert.InRange(got[0] / (double)got[1], 0.5, 1);
            return got.Sum();
        }

        Assert.InRange(Got(share: true), 500, 505);
        Assert.InRange(Got(share: false), 920, 1_000); // control: each has a rate of its own, and asks for 0.86 and 1.14 of it
    }

    [Fact]
    public void Send_LegOfEverythingBehindAQueue_HasTheSameLuckAsWithoutOne()
    {
        // A rate at which nobody waits changes nothing: one that was never asked.
        LinkLeg plain = LinkProfiles.Awful.ToHost;
        LinkLeg wide = new(200, 60, lossPercent: 10, meanBurstLength: 5, reorderPercent: 5, duplicatePercent: 2) { Bottleneck = new Bottleneck(Bottleneck.MaxBitsPerSecond, 100) };
        ulong with = LinkRun.Fingerprint(LinkRun.Of(wide, 5, SimDuration.FromMilliseconds(16), 10_000));
        Assert.Equal(LinkRun.Fingerprint(LinkRun.Of(plain, 5, SimDuration.FromMilliseconds(16), 10_000)), with);

        LinkLeg tight = new(200, 60, lossPercent: 10, meanBurstLength: 5, reorderPercent: 5, duplicatePercent: 2) { Bottleneck = new Bottleneck(50_000, 100) };
        Assert.NotEqual(with, LinkRun.Fingerprint(LinkRun.Of(tight, 5, SimDuration.FromMilliseconds(16), 10_000)));
    }

    [Fact]
    public void Send_BehindAQueue_DelayAndOutageAreThoseOfWhenItLeaves()
    {
        // Five datagrams sent at once leave 100 ms apart, the first at once; an outage of 50 ms a second, from its beginning on.
        LinkLeg leg = new(30) { Bottleneck = new Bottleneck(100_000, 1_000) { BurstBytes = 0 }, Outage = new PeriodicOutage(1, 0.5) };
        SeededRandom seed = new(3);
        LinkModel link = new(leg, seed), withoutQueue = new(new LinkLeg(30) { Outage = leg.Outage }, seed);
        for (int i = 1; i <= 9; i++)
        {
            LinkDeliveries expected = withoutQueue.Send(At(4 + (i * 0.1)), Bytes), got = link.Send(At(4), Bytes);
            Assert.Equal(expected.Count, got.Count);
            Assert.All(Arrivals(got), arrival => Assert.InRange((arrival - expected[0]).Ticks, -20, 20));
        }
    }

    [Fact]
    public void Send_NoBytesOrTooMany_IsRefused()
    {
        LinkModel link = Link(narrow);
        Assert.Throws<ArgumentOutOfRangeException>(() => link.Send(At(1), 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => link.Send(At(1), 65_508));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LinkModel(new LinkLeg(1), new SeededRandom(1)).Send(At(1), 0));
    }

    [Fact]
    public void Send_SharedQueueEarlierThanAnother_IsRefused()
    {
        LinkQueue queue = new(narrow);
        LinkModel one = new(new LinkLeg(0), new SeededRandom(1), null, queue), other = new(new LinkLeg(0), new SeededRandom(2), null, queue);
        one.Send(At(2), 1);
        Assert.Contains("only goes forward", Assert.Throws<ArgumentOutOfRangeException>(() => other.Send(At(1), 1)).Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(999, 100, "rateBitsPerSecond")]
    [InlineData(10_000_000_001, 100, "rateBitsPerSecond")]
    [InlineData(1_000, -1, "queueMilliseconds")]
    [InlineData(1_000, double.NaN, "queueMilliseconds")]
    [InlineData(1_000, 600_001, "queueMilliseconds")]
    public void Bottleneck_ValueOutOfRange_IsRefused(long rate, double queue, string parameter) =>
        Assert.Equal(parameter, Assert.Throws<ArgumentOutOfRangeException>(() => new Bottleneck(rate, queue)).ParamName);

    [Fact]
    public void Bottleneck_BurstOrDisciplineThatThereIsNot_IsRefused()
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new Bottleneck(1_000, 1) { BurstBytes = 1_539 });
        Assert.Throws<ArgumentOutOfRangeException>(() => new Bottleneck(1_000, 1) { BurstBytes = Bottleneck.MaxBurstBytes + 1 });
        Assert.Throws<ArgumentOutOfRangeException>(() => new Bottleneck(1_000, 1, (QueueDiscipline)7));
    }

    [Theory]
    [InlineData(30, 0, 1_000, "lengthSeconds")]
    [InlineData(30, 31, 1_000, "lengthSeconds")]
    [InlineData(0, 5, 1_000, "periodSeconds")]
    [InlineData(30, 5, 0, "rateBitsPerSecond")]
    public void PeriodicDip_ValueOutOfRange_IsRefused(double period, double length, long rate, string parameter) =>
        Assert.Equal(parameter, Assert.Throws<ArgumentOutOfRangeException>(() => new PeriodicDip(period, length, rate)).ParamName);

    private static LinkModel Link(Bottleneck bottleneck) => new(new LinkLeg(0) { Bottleneck = bottleneck }, new SeededRandom(1));

    private static (SimTime At, LinkDeliveries Arrives)[] Run(Bottleneck bottleneck, SimDuration apart, int datagrams) => Run(Link(bottleneck), apart, datagrams);

    private static (SimTime At, LinkDeliveries Arrives)[] Run(LinkModel link, SimDuration apart, int datagrams) =>
        [.. Enumerable.Range(0, datagrams).Select(i => SimTime.Zero + (apart * i)).Select(at => (at, link.Send(at, Bytes)))];

    private static IEnumerable<SimTime> Arrivals(LinkDeliveries deliveries) => Enumerable.Range(0, deliveries.Count).Select(i => deliveries[i]);

    private static SimTime At(double seconds) => SimTime.FromSeconds(seconds);
}
