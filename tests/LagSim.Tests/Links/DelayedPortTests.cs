using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using LagSim.Harness.Relays;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

[Trait("Time", "real")]
public sealed class DelayedPortTests
{
    private static readonly PeerAddress Sender = PeerAddress.Virtual(7);
    private static readonly PeerAddress OtherSender = PeerAddress.Virtual(8);
    private static readonly TimeSpan Long = TimeSpan.FromSeconds(30);

    private readonly VirtualClock clock = new();
    private readonly FakePort inner = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];

    [Fact]
    public void TryReceive_BeforeAndAtTheDueTime_HoldsThenGives()
    {
        using DelayedPort port = WithoutThread(new LinkLeg(25));
        inner.Arrive([1, 2], Sender);
        Assert.False(port.TryReceive(buffer, out _, out _));
        clock.Now = SimTime.FromSeconds(0.025) - SimDuration.OneTick;
        Assert.False(port.TryReceive(buffer, out _, out _));
        clock.Now = SimTime.FromSeconds(0.025);
        Assert.True(port.TryReceive(buffer, out int length, out PeerAddress from));
        Assert.Equal(new byte[] { 1, 2 }, buffer[..length]);
        Assert.Equal(Sender, from);
        Assert.False(port.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void Poll_WhenSomethingFallsDue_RaisesArrivedOnceAndSaysWhatIsNext()
    {
        using DelayedPort port = WithoutThread(new LinkLeg(25));
        int raised = 0;
        port.Arrived += () => raised++;
        inner.Arrive([1], Sender);
        Assert.Equal(SimTime.FromSeconds(0.025), port.Poll());
        clock.Now = SimTime.FromSeconds(0.01);
        inner.Arrive([2], Sender);
        Assert.Equal(SimTime.FromSeconds(0.025), port.Poll());
        Assert.Equal(0, raised);

        clock.Now = SimTime.FromSeconds(0.03);
        Assert.Equal(SimTime.FromSeconds(0.01) + SimDuration.FromMilliseconds(25), port.Poll());
        Assert.Equal(1, raised);
        port.Poll();
        Assert.Equal(1, raised);
        clock.Now = SimTime.FromSeconds(1);
        Assert.Null(port.Poll());
        Assert.Equal(2, raised);
        Assert.Equal([1, 2], Drain(port));
    }

    [Fact]
    public void TryReceive_LossyJitteryLink_GivesWhatTheLinkModelSays()
    {
        using DelayedPort port = WithoutThread(LinkProfiles.Awful.ToHost);
        LinkModel oracle = new(LinkProfiles.Awful.ToHost, new SeededRandom(1).Fork(0));
        List<(SimTime Due, int Order, byte Number)> expected = [];
        List<byte> got = [];
        for (byte i = 0; i < 250; i++)
        {
            clock.Now += SimDuration.FromMilliseconds(16);
            LinkDeliveries deliveries = oracle.Send(clock.Now, 1);
            expected.AddRange(Enumerable.Range(0, deliveries.Count).Select(copy => (deliveries[copy], (i * 2) + copy, i)));
            inner.Arrive([i], Sender);
            port.Poll();
            got.AddRange(Drain(port));
        }

        clock.Now += SimDuration.FromSeconds(10);
        got.AddRange(Drain(port));

        // Taken every 16 ms, so the order of arrival is by due time, whatever was taken together.
        Assert.Equal(expected.Order().Select(datagram => datagram.Number), got);
    }

    [Theory]
    [InlineData(QueueDiscipline.DropTail)]
    [InlineData(QueueDiscipline.CoDel)]
    public void TryReceive_NarrowLink_GivesWhatTheLinkModelSaysWhenItSays(QueueDiscipline discipline)
    {
        LinkLeg leg = new(20, 2) { Bottleneck = new Bottleneck(100_000, 1_000, discipline) };
        using DelayedPort port = WithoutThread(leg);
        LinkModel oracle = new(leg, new SeededRandom(1).Fork(0));
        List<(SimTime Due, byte Number)> expected = [], got = [];
        void Until(SimTime time)
        {
            while (port.Poll() is SimTime next && next <= time)
            {
                clock.Now = SimTime.Max(clock.Now, next);
                port.Poll();
                got.AddRange(Drain(port).Select(number => (clock.Now, number)));
            }

            clock.Now = time;
        }

        for (byte i = 0; i < 250; i++)
        {
            Until(SimTime.FromSeconds(0.06 * i)); // 133 kbit/s
            byte number = i;
            oracle.Send(clock.Now, 958, deliveries => expected.AddRange(Enumerable.Range(0, deliveries.Count).Select(copy => (deliveries[copy], number))));
            inner.Arrive([i, .. new byte[957]], Sender);
        }

        Until(SimTime.FromSeconds(60));
        oracle.Queue!.DecideUntil(clock.Now);
        Assert.Null(port.Poll());
        Assert.Equal(expected.Order(), got);
        Assert.InRange(got.Count, 150, 240);
    }

    [Fact]
    public void TryReceive_TwoSenders_EachHasItsOwnLink()
    {
        LinkLeg slow = new(100), fast = new(10);
        SeededRandom random = new(1);
        using DelayedPort port = new(inner, clock, from => new LinkModel(from == Sender ? slow : fast, random), waits: false);
        inner.Arrive([1], Sender);
        inner.Arrive([2], OtherSender);
        port.Poll();
        clock.Now = SimTime.FromSeconds(1);
        Assert.Equal([2, 1], Drain(port));
    }

    [Fact]
    public void Send_Datagram_GoesOutAtOnce()
    {
        using DelayedPort port = WithoutThread(new LinkLeg(25));
        port.Send([9], Sender);
        Assert.Equal((byte)9, Assert.Single(inner.Sent)[0]);
        Assert.Equal(inner.LocalAddress, port.LocalAddress);
    }

    [Fact]
    public void Dispose_WithDatagramsHeld_DisposesTheInnerPortAndGivesNothingMore()
    {
        DelayedPort port = WithoutThread(new LinkLeg(25));
        inner.Arrive([1], Sender);
        port.Poll();
        port.Dispose();
        port.Dispose();
        clock.Now = SimTime.FromSeconds(1);
        Assert.Equal(1, inner.Disposals);
        Assert.False(inner.HasListeners);
        Assert.False(port.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void Arrived_InRealTime_IsRaisedOnceDueAndNotBefore()
    {
        StopwatchClock real = new();
        using DelayedPort port = new(inner, real, new LinkLeg(20), 1);
        using ManualResetEventSlim raised = new();
        SimTime at = default;
        port.Arrived += () =>
        {
            at = real.Now;
            raised.Set();
        };
        SimTime before = real.Now;
        inner.Arrive([1], Sender);
        Assert.True(raised.Wait(Long, TestContext.Current.CancellationToken));

        // No upper bound: a busy machine may be late. The lower one is exact.
        Assert.True(at - before >= SimDuration.FromMilliseconds(20));
        Assert.True(port.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void Dispose_WhileTheThreadWaitsForLong_DoesNotWaitForIt()
    {
        DelayedPort port = new(inner, new StopwatchClock(), new LinkLeg(600_000), 1);
        inner.Arrive([1], Sender);
        Thread disposer = new(port.Dispose) { IsBackground = true };
        disposer.Start();
        Assert.True(disposer.Join(Long));
    }

    [Fact]
    public void Dispose_InAHandlerOfArrived_DoesNotDeadlock()
    {
        DelayedPort port = new(inner, new StopwatchClock(), new LinkLeg(0), 1);
        using ManualResetEventSlim disposed = new();
        port.Arrived += () =>
        {
            port.Dispose();
            disposed.Set();
        };
        inner.Arrive([1], Sender);
        Assert.True(disposed.Wait(Long, TestContext.Current.CancellationToken));
    }

    [Fact]
    public void Arrived_InnerPortFedFromManyThreads_LosesNothing()
    {
        const int Threads = 4, Each = 500;
        using DelayedPort port = new(inner, new StopwatchClock(), new LinkLeg(1, 0.5), 1);
        using SemaphoreSlim raised = new(0);
        port.Arrived += () => raised.Release();
        Thread[] feeders = Enumerable.Range(0, Threads).Select(t => new Thread(() =>
        {
            for (int i = 0; i < Each; i++)
            {
                inner.Arrive([(byte)t], Sender);
            }
        })).ToArray();
        Array.ForEach(feeders, feeder => feeder.Start());

        int got = 0;
        while (got < Threads * Each)
        {
            Assert.True(raised.Wait(Long, TestContext.Current.CancellationToken));
            got += Drain(port).Count;
        }

        Array.ForEach(feeders, feeder => feeder.Join());
        Assert.Equal(Threads * Each, got);
    }

    [Fact]
    public void CountingPort_BothWays_CountsBytesWithTheirHeaders()
    {
        using CountingPort port = new(inner);
        int raised = 0;
        port.Arrived += () => raised++;
        port.Send(new byte[10], Sender);
        inner.Arrive(new byte[5], Sender);
        inner.Arrive(new byte[6], Sender);
        Assert.Equal(2, Drain(port).Count);
        Assert.Equal(2, raised);
        Assert.Equal(new PortTraffic(1, 38, 2, 67), port.Traffic);
    }

    private DelayedPort WithoutThread(LinkLeg leg) => new(inner, clock, HeldDatagrams.SameLegs(leg, 1), waits: false);

    private List<byte> Drain(IDatagramPort port)
    {
        List<byte> all = [];
        while (port.TryReceive(buffer, out _, out _))
        {
            all.Add(buffer[0]);
        }

        return all;
    }

    private sealed class StopwatchClock : IClock
    {
        private readonly Stopwatch watch = Stopwatch.StartNew();

        public SimTime Now => SimTime.FromSeconds(watch.Elapsed.TotalSeconds);
    }

    private sealed class FakePort : IDatagramPort
    {
        private readonly ConcurrentQueue<(byte[] Datagram, PeerAddress From)> inbox = new();

        public event Action? Arrived;

        public PeerAddress LocalAddress => PeerAddress.Virtual(1);

        internal List<byte[]> Sent { get; } = [];

        internal int Disposals { get; private set; }

        internal bool HasListeners => Arrived is not null;

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => Sent.Add(datagram.ToArray());

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            bool any = inbox.TryDequeue(out (byte[] Datagram, PeerAddress From) next);
            length = any ? next.Datagram.Length : 0;
            from = next.From;
            next.Datagram?.CopyTo(buffer);
            return any;
        }

        public void Dispose() => Disposals++;

        internal void Arrive(byte[] datagram, PeerAddress from)
        {
            inbox.Enqueue((datagram, from));
            Arrived?.Invoke();
        }
    }
}
