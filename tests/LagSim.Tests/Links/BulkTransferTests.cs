using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class BulkTransferTests
{
    private const long Megabit = 1_000_000;

    private readonly VirtualClock clock = new();

    [Theory]
    [InlineData(Megabit, 100, 20)]
    [InlineData(Megabit, 200, 100)]
    [InlineData(Megabit, 2_000, 20)]
    [InlineData(256_000, 500, 25)]
    [InlineData(10 * Megabit, 100, 20)]
    public void RunUntil_AloneOnALink_FillsMoreThanNineTenthsOfIt(long rate, double queue, double delay)
    {
        VirtualNetwork network = Network(1, new LinkLeg(delay, 2) { Bottleneck = new Bottleneck(rate, queue) });
        BulkTransfer transfer = network.StartBulkTransfer(0, 1);
        RunUntil(network, 60);
        long before = transfer.ReceivedBytes; // slow start overshoots, and what it costs to get back is not what a long transfer is like
        RunUntil(network, 240);
        double segments = (transfer.ReceivedBytes - before) / (double)BulkTransfer.SegmentBytes;
        Tell($"{segments * 1_514 * 8 / 180 / rate:0.000} of {rate} bit/s, {transfer.GoodputBitsPerSecond(clock.Now) / rate:0.000} with the beginning, {transfer.Timeouts} timeouts");
        Assert.InRange(segments * 1_514 * 8 / 180 / rate, 0.9, 1.001);
    }

    [Fact]
    public void RunUntil_LossOnTheWay_SendsAsMuchAsNewRenoDoes()
    {
        // Mathis et al. 1997: 1.22 segments a round trip, over the root of the loss, if losses are evenly spaced; some percent more if they are not.
        double Share(double percent, ulong seed)
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, seed);
            network.SetLink(0, 1, new LinkLeg(50, lossPercent: percent, meanBurstLength: 1 / (1 - (percent / 100))) { Bottleneck = new Bottleneck(100 * Megabit, 100) });
            network.SetLink(1, 0, new LinkLeg(50));
            BulkTransfer transfer = network.StartBulkTransfer(0, 1);
            network.DeliverUntil(SimTime.FromSeconds(600));
            double mathis = 1.22 * BulkTransfer.SegmentBytes * 8 / 0.1 / Math.Sqrt(percent / 100);
            Tell($"{percent} %: {transfer.GoodputBitsPerSecond(own.Now) / 1000:0} kbit/s, {transfer.GoodputBitsPerSecond(own.Now) / mathis:0.00} of the formula, {transfer.Timeouts} timeouts");
            return transfer.GoodputBitsPerSecond(own.Now) / mathis;
        }

        for (ulong seed = 1; seed <= 3; seed++)
        {
            Assert.InRange(Share(0.1, seed), 0.8, 1.3);
            Assert.InRange(Share(1, seed), 0.8, 1.3);
        }
    }

    [Fact]
    public void RunUntil_NothingArrives_TriesTwiceAsSeldomEachTime()
    {
        // RFC 6298: after 1, 2, 4, 8, 16, 32 s, that is at 1, 3, 7, 15, 31 and 63 s, and from then on once a minute.
        VirtualNetwork network = Network(1, new LinkLeg(10, lossPercent: 100) { Bottleneck = new Bottleneck(Megabit, 500) });
        BulkTransfer transfer = network.StartBulkTransfer(0, 1);
        (double Until, int Timeouts)[] expected = [(0.999, 0), (2.999, 1), (6.999, 2), (62.999, 5), (63, 6), (122.999, 6), (123, 7), (183, 8)];
        foreach ((double until, int timeouts) in expected)
        {
            RunUntil(network, until);
            Assert.Equal((timeouts, 10 + timeouts, timeouts), (transfer.Timeouts, transfer.SegmentsSent, transfer.SegmentsSentAgain));
        }

        Assert.Equal(0, transfer.ReceivedBytes);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void RunUntil_TwoOnOneLink_ShareItWithinAFactorOfTwo(ulong seed)
    {
        VirtualNetwork network = new(clock, seed);
        LinkQueue queue = new(new Bottleneck(Megabit, 200));
        foreach (int player in new[] { 1, 2 })
        {
            network.SetLink(0, player, new LinkLeg(20, 2), queue);
        }

        BulkTransfer one = network.StartBulkTransfer(0, 1), other = network.StartBulkTransfer(0, 2);
        RunUntil(network, 300);
        double share = one.GoodputBitsPerSecond(clock.Now) / other.GoodputBitsPerSecond(clock.Now);
        Tell($"{one.GoodputBitsPerSecond(clock.Now):0} and {other.GoodputBitsPerSecond(clock.Now):0} bit/s");
        Assert.InRange(share, 0.5, 2);
        Assert.InRange(one.GoodputBitsPerSecond(clock.Now) + other.GoodputBitsPerSecond(clock.Now), 0.85 * Megabit, Megabit);
    }

    [Fact]
    public void RunUntil_BesideASenderThatNeverBacksOff_IsStarved()
    {
        // Negative control of the one above: who backs off leaves all to who does not.
        VirtualNetwork network = new(clock, 1);
        LinkQueue queue = new(new Bottleneck(Megabit, 200));
        IDatagramPort host = network.CreatePort(0), player = network.CreatePort(2);
        network.SetLink(0, 1, new LinkLeg(20, 2), queue);
        network.SetLink(0, 2, new LinkLeg(20, 2), queue);
        BulkTransfer transfer = network.StartBulkTransfer(0, 1);
        for (int i = 0; i < 9_000; i++)
        {
            RunUntil(network, i / 100.0);
            host.Send(new byte[IDatagramPort.MaxDatagramBytes], player.LocalAddress); // 0.99 Mbit/s with its overhead
        }

        Tell($"{transfer.GoodputBitsPerSecond(clock.Now):0} bit/s");
        Assert.InRange(transfer.GoodputBitsPerSecond(clock.Now), 0, 0.1 * Megabit);
        Assert.InRange(network.Traffic(2).DatagramsReceived, 8_500, 9_000);
    }

    [Fact]
    public void RunUntil_SameSeed_IsTheSameAndAnotherIsNot()
    {
        string Trace(ulong seed)
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, seed);
            network.Connect(1, 0, LinkProfiles.Bufferbloat);
            BulkTransfer transfer = network.StartBulkTransfer(0, 1);
            network.DeliverUntil(SimTime.FromSeconds(60));
            return $"{transfer.ReceivedBytes} {transfer.SegmentsSent} {transfer.Timeouts}";
        }

        Assert.Equal(Trace(1), Trace(1));
        Assert.Contains(Enumerable.Range(2, 5), seed => Trace((ulong)seed) != Trace(1));
    }

    [Fact]
    public void RunUntil_InStepsOrAtOnce_IsTheSame()
    {
        // Nobody has to step it: who sends through its queue finds it where it is by then.
        double[] Delays(double step)
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, 4, LinkProfiles.Bufferbloat);
            return Pings(own, network, 0, 1, 20, step);
        }

        Assert.Equal(Delays(0.1), Delays(0.003));
    }

    [Fact]
    public void Connect_ProfileWithATransfer_PlayersWaitBehindIt()
    {
        // The second half of two minutes: the queue's 2 s are there to wait for. Up there are acknowledgements only.
        double[] Waits(LinkProfile profile, int from, int to, bool connect)
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, 2, connect ? null : profile);
            if (connect)
            {
                network.Connect(1, 0, profile);
            }

            double[] delays = Pings(own, network, from, to, 120)[1_200..];
            Tell($"{profile} {from} to {to}: p50 {delays.Percentile(50):0}, p99 {delays.Percentile(99):0} ms, {delays.Length} of 1200");
            return delays;
        }

        LinkProfile alone = new("alone", LinkProfiles.Bufferbloat.ToHost, LinkProfiles.Bufferbloat.FromHost);
        Assert.InRange(Waits(LinkProfiles.Bufferbloat, 0, 1, true).Percentile(50), 800, 2_100);
        Assert.InRange(Waits(LinkProfiles.Bufferbloat, 0, 1, false).Percentile(50), 800, 2_100);
        Assert.InRange(Waits(LinkProfiles.Bufferbloat, 1, 0, true).Percentile(50), 15, 30);
        Assert.InRange(Waits(alone, 0, 1, true).Percentile(99), 15, 30);
    }

    [Fact]
    public void Send_BesideATransferInAQueueOfCoDel_HardlyWaits()
    {
        double[] Waits(QueueDiscipline discipline, out double goodput)
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, 3);
            network.SetLink(0, 1, new LinkLeg(20, 2) { Bottleneck = new Bottleneck(Megabit, 1_000, discipline) });
            network.SetLink(1, 0, new LinkLeg(20, 2) { Bottleneck = new Bottleneck(Megabit, 1_000, discipline) });
            BulkTransfer transfer = network.StartBulkTransfer(0, 1);
            double[] delays = Pings(own, network, 0, 1, 120)[1_200..];
            goodput = transfer.GoodputBitsPerSecond(own.Now);
            Tell($"{discipline}: p50 {delays.Percentile(50):0}, p99 {delays.Percentile(99):0} ms, {goodput:0} bit/s");
            return delays;
        }

        Assert.InRange(Waits(QueueDiscipline.CoDel, out double codel).Percentile(50), 20, 100);
        Assert.InRange(Waits(QueueDiscipline.DropTail, out double tail).Percentile(50), 400, 1_100);
        Assert.InRange(codel, 0.75 * Megabit, Megabit);
        Assert.InRange(tail, 0.75 * Megabit, Megabit);
    }

    [Fact]
    public void SetLink_EitherDirection_EndsTheTransfer()
    {
        foreach ((int from, int to) in new[] { (0, 1), (1, 0) })
        {
            VirtualClock own = new();
            VirtualNetwork network = new(own, 1);
            network.Connect(1, 0, new LinkProfile("narrow", new LinkLeg(5) { Bottleneck = new Bottleneck(Megabit, 100) }));
            BulkTransfer transfer = network.StartBulkTransfer(0, 1);
            network.DeliverUntil(SimTime.FromSeconds(5));
            network.SetLink(from, to, new LinkLeg(0));
            long sent = transfer.SegmentsSent;
            network.DeliverUntil(SimTime.FromSeconds(10));
            Assert.Equal(sent, transfer.SegmentsSent);
            Assert.True(sent > 100);
        }
    }

    [Fact]
    public void StartBulkTransfer_WayWithoutABottleneck_IsRefused()
    {
        VirtualNetwork network = new(clock, 1, LinkProfiles.Lan);
        Assert.Contains("from 0 to 1 needs a bottleneck", Assert.Throws<InvalidOperationException>(() => network.StartBulkTransfer(0, 1)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void GoodputBitsPerSecond_BeforeTheStart_IsRefused()
    {
        BulkTransfer transfer = Network(1, LinkProfiles.Bufferbloat.ToHost).StartBulkTransfer(0, 1);
        Assert.Throws<ArgumentOutOfRangeException>(() => transfer.GoodputBitsPerSecond(SimTime.Zero));
    }

    private static void Tell(FormattableString what) => TestContext.Current.TestOutputHelper?.WriteLine(FormattableString.Invariant(what));

    /// <summary>The delays in milliseconds of what a node sends another every 50 ms; the lost left out.</summary>
    private static double[] Pings(VirtualClock clock, VirtualNetwork network, int from, int to, double seconds, double step = 0.05)
    {
        using IDatagramPort sender = network.CreatePort(from), receiver = network.CreatePort(to);
        byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        List<double> delays = [];
        receiver.Arrived += () =>
        {
            Assert.True(receiver.TryReceive(buffer, out _, out _));
            delays.Add((clock.Now - SimTime.FromTicks(BitConverter.ToInt64(buffer))).ToMilliseconds());
        };
        SimTime end = clock.Now + SimDuration.FromSeconds(seconds), due = clock.Now;
        while (clock.Now < end)
        {
            if (clock.Now >= due)
            {
                sender.Send([.. BitConverter.GetBytes(clock.Now.Ticks), .. new byte[92]], receiver.LocalAddress);
                due += SimDuration.FromMilliseconds(50);
            }

            network.DeliverUntil(SimTime.Min(due, clock.Now + SimDuration.FromSeconds(step)));
        }

        network.DeliverUntil(end + SimDuration.FromSeconds(5));
        return [.. delays];
    }

    private VirtualNetwork Network(ulong seed, LinkLeg bothWays)
    {
        VirtualNetwork network = new(clock, seed);
        network.Connect(1, 0, new LinkProfile("narrow", bothWays));
        return network;
    }

    private void RunUntil(VirtualNetwork network, double seconds) => network.DeliverUntil(SimTime.FromSeconds(seconds));
}
