using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class VirtualNetworkTests
{
    private readonly VirtualClock clock = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];

    [Fact]
    public void DeliverUntil_BeforeAndAtTheDelivery_ArrivesExactlyThen()
    {
        VirtualNetwork network = new(clock, 1, LinkProfiles.PureDelay(25));
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        SimTime? seenAt = null;
        b.Arrived += () => seenAt = clock.Now;
        a.Send([1, 2, 3], b.LocalAddress);

        SimTime due = SimTime.FromSeconds(0.025);
        Assert.Equal(due, network.NextDelivery);
        Assert.Equal(0, network.DeliverUntil(due - SimDuration.OneTick));
        Assert.False(b.TryReceive(buffer, out _, out _));

        Assert.Equal(1, network.DeliverUntil(SimTime.FromSeconds(1)));
        Assert.Equal(due, seenAt);
        Assert.Equal(SimTime.FromSeconds(1), clock.Now);
        Assert.Null(network.NextDelivery);
        Assert.True(b.TryReceive(buffer, out int length, out PeerAddress from));
        Assert.Equal(new byte[] { 1, 2, 3 }, buffer[..length]);
        Assert.Equal(a.LocalAddress, from);
        Assert.False(b.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void DeliverUntil_ManyAtTheSameTick_ArriveInTheOrderSent()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort[] nodes = Enumerable.Range(0, 4).Select(network.CreatePort).ToArray();
        for (byte i = 0; i < 200; i++)
        {
            nodes[1 + (i % 3)].Send([i], nodes[0].LocalAddress);
        }

        network.DeliverUntil(clock.Now);
        Assert.Equal(Enumerable.Range(0, 200).Select(i => (byte)i), Drain(nodes[0]).Select(datagram => datagram[0]));
    }

    [Fact]
    public void NextDelivery_WhileDelivering_NeverGoesBackAndMatchesEachArrival()
    {
        VirtualNetwork network = new(clock, 3, LinkProfiles.Awful);
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        List<SimTime> arrivals = [];
        b.Arrived += () => arrivals.Add(clock.Now);
        List<SimTime> announced = [];
        for (int i = 0; i < 2000; i++)
        {
            SimTime tick = clock.Now + SimDuration.FromMilliseconds(10);
            while (network.NextDelivery is SimTime next && next <= tick)
            {
                int delivered = network.DeliverUntil(next);
                Assert.True(delivered >= 1);
                announced.AddRange(Enumerable.Repeat(next, delivered));
            }

            network.DeliverUntil(tick);
            a.Send([(byte)i], b.LocalAddress);
        }

        Assert.Equal(announced, arrivals);
        Assert.Equal(arrivals.Order(), arrivals);
        Assert.NotEmpty(arrivals);
    }

    [Fact]
    public void Run_SameSeed_IsTheSameRunAndAnotherSeedIsNot()
    {
        Assert.Equal(Trace(1, 0), Trace(1, 0));
        Assert.NotEqual(Trace(1, 0), Trace(2, 0));
    }

    [Fact]
    public void Run_TrafficOfAnotherPair_ChangesNothingForThisOne()
    {
        Assert.Equal(Trace(1, 0), Trace(1, 5));
    }

    [Fact]
    public void Send_BothDirectionsOfOneProfile_HaveTheirOwnLuck()
    {
        VirtualNetwork network = new(clock, 1, LinkProfiles.Awful);
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        List<bool> up = [], down = [];
        network.Lose((from, _, _) => false);
        for (int i = 0; i < 1000; i++)
        {
            long before = network.DatagramsLost;
            a.Send([1], b.LocalAddress);
            down.Add(network.DatagramsLost > before);
            before = network.DatagramsLost;
            b.Send([1], a.LocalAddress);
            up.Add(network.DatagramsLost > before);
        }

        Assert.NotEqual(up, down);
    }

    [Fact]
    public void Connect_AsymmetricProfile_GivesEachDirectionItsOwnLeg()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort host = network.CreatePort(5), player = network.CreatePort(2);
        network.Connect(player: 2, host: 5, new LinkProfile("asymmetric", toHost: new LinkLeg(10), fromHost: new LinkLeg(200)));
        player.Send([1], host.LocalAddress);
        Assert.Equal(SimTime.FromSeconds(0.01), network.NextDelivery);
        network.DeliverUntil(SimTime.FromSeconds(1));
        host.Send([1], player.LocalAddress);
        Assert.Equal(SimTime.FromSeconds(1.2), network.NextDelivery);
    }

    [Fact]
    public void Lose_ChosenDatagram_IsLostForGoodAndNoOtherChanges()
    {
        Assert.Equal(
            Trace(1, 0).Where(arrival => arrival.Datagram != 17),
            Trace(1, 0, (from, to, datagram) => from == 0 && to == 1 && datagram.Span[0] == 17));
    }

    [Fact]
    public void Traffic_AfterSending_CountsBytesWithTheirHeaders()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        network.Lose((_, _, datagram) => datagram.Length == 7);
        a.Send(new byte[100], b.LocalAddress);
        a.Send(new byte[7], b.LocalAddress);
        a.Send(new byte[50], PeerAddress.Virtual(99));
        network.DeliverUntil(clock.Now);
        Assert.Equal(new PortTraffic(3, 157 + (3 * 28), 0, 0), network.Traffic(0));
        Assert.Equal(new PortTraffic(0, 0, 1, 128), network.Traffic(1));
        Assert.Equal(2, network.DatagramsLost);
    }

    [Fact]
    public void Send_BufferReusedByTheSender_ArrivesAsItWasSent()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        byte[] reused = [1];
        a.Send(reused, b.LocalAddress);
        reused[0] = 2;
        network.DeliverUntil(clock.Now);
        Assert.Equal(1, Assert.Single(Drain(b))[0]);
    }

    [Fact]
    public void Send_WrongSizeOrNoAddress_IsRefused()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort a = network.CreatePort(0);
        Assert.Throws<ArgumentException>(() => a.Send([], PeerAddress.Virtual(1)));
        Assert.Throws<ArgumentException>(() => a.Send(new byte[IDatagramPort.MaxDatagramBytes + 1], PeerAddress.Virtual(1)));
        Assert.Throws<ArgumentException>(() => a.Send([1], default));
    }

    [Fact]
    public void CreatePort_NumberTakenThenDisposed_IsRefusedThenMadeAnew()
    {
        VirtualNetwork network = new(clock, 1, LinkProfiles.PureDelay(10));
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        Assert.Throws<InvalidOperationException>(() => network.CreatePort(1));
        a.Send([1], b.LocalAddress);
        b.Dispose();
        Assert.Equal(0, network.DeliverUntil(SimTime.FromSeconds(1)));
        Assert.Equal(1, network.DatagramsLost);

        IDatagramPort again = network.CreatePort(1);
        a.Send([2], again.LocalAddress);
        network.DeliverUntil(SimTime.FromSeconds(2));
        Assert.Equal(2, Assert.Single(Drain(again))[0]);
    }

    [Fact]
    public void SetLink_InTheMiddleOfARun_CutsAndRestoresTheDirection()
    {
        VirtualNetwork network = new(clock, 1);
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        network.SetLink(0, 1, new LinkLeg(0, lossPercent: 100));
        a.Send([1], b.LocalAddress);
        b.Send([2], a.LocalAddress);
        network.SetLink(0, 1, new LinkLeg(0));
        a.Send([3], b.LocalAddress);
        network.DeliverUntil(clock.Now);
        Assert.Equal(3, Assert.Single(Drain(b))[0]);
        Assert.Equal(2, Assert.Single(Drain(a))[0]);
    }

    private List<byte[]> Drain(IDatagramPort port)
    {
        List<byte[]> all = [];
        while (port.TryReceive(buffer, out int length, out _))
        {
            all.Add(buffer[..length]);
        }

        return all;
    }

    /// <summary>What arrives at node 1 from node 0 of 250 numbered datagrams over the awful link, while node 2 also sends so many.</summary>
    [Fact]
    public void Move_APortWithANewAddress_SendsFromThereAndLosesWhatIsSentToTheFormerOne()
    {
        VirtualNetwork network = new(clock, 1, LinkProfiles.PureDelay(25));
        IDatagramPort host = network.CreatePort(0), player = network.CreatePort(1);
        PeerAddress former = player.LocalAddress;
        host.Send([1], former); // on its way when the address changes
        network.Move(1, 1001);
        host.Send([2], former);
        host.Send([3], player.LocalAddress);
        player.Send([4], host.LocalAddress);
        Assert.Equal(PeerAddress.Virtual(1001), player.LocalAddress);

        network.DeliverUntil(SimTime.FromSeconds(1));
        Assert.True(host.TryReceive(buffer, out int length, out PeerAddress from));
        Assert.Equal((4, 1, player.LocalAddress), (buffer[0], length, from));
        Assert.Equal([[3]], Drain(player));
        Assert.Equal(2, network.DatagramsLost);
        Assert.Equal((1, 1), (network.Traffic(1).DatagramsSent, network.Traffic(1).DatagramsReceived)); // by its number, wherever it is

        Assert.Throws<InvalidOperationException>(() => network.Move(1, 0));
        Assert.Throws<InvalidOperationException>(() => network.CreatePort(1)); // it is there still, elsewhere
        Assert.Throws<ArgumentOutOfRangeException>(() => network.Move(1, -1));
        player.Dispose();
        Assert.Equal(PeerAddress.Virtual(1), network.CreatePort(1).LocalAddress);
    }

    [Fact]
    public void PortRoom_MoreThanThePortTakes_TheNewestAreLost()
    {
        VirtualNetwork network = new(clock, 1) { PortRoom = 3 };
        IDatagramPort a = network.CreatePort(0), b = network.CreatePort(1);
        for (byte n = 1; n <= 5; n++)
        {
            a.Send([n], b.LocalAddress);
        }

        Assert.Equal(3, network.DeliverUntil(clock.Now));
        Assert.Equal([[1], [2], [3]], Drain(b));
        Assert.Equal(2, network.DatagramsLost);
    }

    private static List<(SimTime At, byte Datagram)> Trace(
        ulong seed, int others, Func<int, int, ReadOnlyMemory<byte>, bool>? lose = null)
    {
        VirtualClock clock = new();
        VirtualNetwork network = new(clock, seed, LinkProfiles.Awful);
        IDatagramPort[] nodes = Enumerable.Range(0, 3).Select(network.CreatePort).ToArray();
        byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        List<(SimTime, byte)> trace = [];
        nodes[1].Arrived += () =>
        {
            Assert.True(nodes[1].TryReceive(buffer, out _, out PeerAddress from));
            if (from == nodes[0].LocalAddress)
            {
                trace.Add((clock.Now, buffer[0]));
            }
        };
        if (lose is not null)
        {
            network.Lose(lose);
        }

        for (byte i = 0; i < 250; i++)
        {
            for (int j = 0; j < others; j++)
            {
                nodes[2].Send([i], nodes[1].LocalAddress);
            }

            nodes[0].Send([i], nodes[1].LocalAddress);
            network.DeliverUntil(clock.Now + SimDuration.FromMilliseconds(16));
        }

        network.DeliverUntil(clock.Now + SimDuration.FromSeconds(10));
        return trace;
    }
}
