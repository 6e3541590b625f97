using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Relays;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>The relay in virtual time, on a network that adds nothing of its own.</summary>
public sealed class RelayCoreTests : IDisposable
{
    private const int Front = 10, FirstClient = 1, FirstBack = 20;
    private const int MaxClients = 4;

    private static readonly LinkProfile Uneven = new("uneven", toHost: new LinkLeg(10), fromHost: new LinkLeg(200));

    private readonly VirtualClock clock = new();
    private readonly VirtualNetwork network;
    private readonly IDatagramPort host;
    private readonly IDatagramPort[] clients;
    private readonly List<IDatagramPort> backs = [];
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private RelayCore? relay;
    private bool outOfPorts;

    public RelayCoreTests()
    {
        network = new VirtualNetwork(clock, 1);
        host = network.CreatePort(0);
        clients = Enumerable.Range(FirstClient, MaxClients + 1).Select(network.CreatePort).ToArray();
    }

    public void Dispose() => relay?.Dispose();

    [Fact]
    public void Poll_BothWays_HandsOnExactlyWhenDueAndSaysWhenThatIs()
    {
        Relay(Uneven);
        Send(clients[0], 7);
        SimTime there = At(10);
        Assert.Equal(there, Turn());
        Assert.Null(TurnAt(there - SimDuration.OneTick, host));
        Assert.Equal((byte)7, TurnAt(there, host)!.Value.Number);

        host.Send([8], backs[0].LocalAddress);
        Assert.Equal(At(210), Turn());
        Assert.Null(TurnAt(At(210) - SimDuration.OneTick, clients[0]));
        Assert.Equal(((byte)8, PeerAddress.Virtual(Front)), TurnAt(At(210), clients[0]));
        Assert.Null(relay!.Poll(clock.Now));
        Assert.Equal(new RelayTraffic(1, 1, 0, 1, 0, 0), relay.Traffic);
    }

    [Fact]
    public void Poll_ManyOnTheirWay_SaysTheEarliestOfAll()
    {
        Relay(Uneven);
        Send(clients[0], 1);
        Turn();
        TurnAt(At(10), host);
        host.Send([2], backs[0].LocalAddress); // due at 210
        Turn();
        TurnAt(At(50), host);
        Send(clients[1], 3); // due at 60
        Assert.Equal(At(60), Turn());
        TurnAt(At(60), host);
        Assert.Equal(At(210), Turn());
    }

    [Fact]
    public void Poll_TwoClients_AreToldApartByTheHostAndEachGetsItsOwnAnswers()
    {
        Relay(LinkProfiles.PureDelay(5));
        Send(clients[0], 1);
        Send(clients[1], 2);
        Send(clients[0], 3);
        Turn();
        clock.Now = At(5);
        Turn();
        (byte Number, PeerAddress From)[] heard = [.. Drain(host)];
        Assert.Equal([1, 2, 3], heard.Select(datagram => datagram.Number));
        Assert.Equal(heard[0].From, heard[2].From);
        Assert.NotEqual(heard[0].From, heard[1].From);

        host.Send([11], heard[0].From);
        host.Send([12], heard[1].From);
        Turn();
        clock.Now = At(10);
        Turn();
        Assert.Equal([11], Drain(clients[0]).Select(datagram => datagram.Number));
        Assert.Equal([12], Drain(clients[1]).Select(datagram => datagram.Number));
    }

    [Fact]
    public void Poll_AwfulProfile_LosesDoublesAndDelaysAsTheLinkModelSays()
    {
        const int Sent = 250;
        Relay(LinkProfiles.Awful);
        SeededRandom luck = new SeededRandom(1).Fork(0);
        LinkModel oracle = new(LinkProfiles.Awful.ToHost, luck.Fork(0), luck.Fork(2));
        List<(SimTime Due, int Order, byte Number)> expected = [];
        List<byte> heard = [];
        int lost = 0;
        for (int i = 0; i < Sent; i++)
        {
            LinkDeliveries deliveries = oracle.Send(clock.Now, 1);
            lost += deliveries.Count == 0 ? 1 : 0;
            expected.AddRange(Enumerable.Range(0, deliveries.Count).Select(copy => (deliveries[copy], (i * 2) + copy, (byte)i)));
            Send(clients[0], (byte)i);
            Turn();
            clock.Now += SimDuration.FromMilliseconds(16);
            Turn();
            heard.AddRange(Drain(host).Select(datagram => datagram.Number));
        }

        clock.Now += SimDuration.FromSeconds(10);
        Turn();
        heard.AddRange(Drain(host).Select(datagram => datagram.Number));
        Assert.Equal(expected.Order().Select(datagram => datagram.Number), heard);
        Assert.True(lost > 0 && expected.Count > Sent - lost);
        Assert.Equal(new RelayTraffic(1, expected.Count, lost, 0, 0, 0), relay!.Traffic);
    }

    [Fact]
    public void Poll_Blackout_SilencesAClientBothWaysAtOnce()
    {
        Relay(LinkProfiles.Blackout);
        Send(clients[0], 0);
        Turn();
        RelayTraffic before = relay!.Traffic;
        List<(bool Up, bool Down)> lost = [];
        for (int i = 0; i < 4000; i++)
        {
            clock.Now += SimDuration.FromMilliseconds(10);
            Send(clients[0], 1);
            host.Send([1], backs[0].LocalAddress);
            Turn();
            RelayTraffic now = relay.Traffic;
            lost.Add((now.LostToHost > before.LostToHost, now.LostFromHost > before.LostFromHost));
            before = now;
        }

        Assert.All(lost, pair => Assert.Equal(pair.Up, pair.Down));
        Assert.InRange(lost.Count(pair => pair.Up), 299, 301); // two of 1.5 s in 40 s
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Poll_ProfileWithABulkTransfer_ClientsWaitBehindIt(bool hasTransfer)
    {
        Relay(hasTransfer ? LinkProfiles.Bufferbloat : new LinkProfile("alone", LinkProfiles.Bufferbloat.ToHost, LinkProfiles.Bufferbloat.FromHost));
        Send(clients[0], 0);
        Turn();
        clock.Now = SimTime.FromSeconds(60);
        Turn();
        host.Send([1], backs[0].LocalAddress);
        Send(clients[0], 2);
        Turn();
        clock.Now += SimDuration.FromMilliseconds(100);
        Turn();
        Assert.Equal([0, 2], Drain(host).Select(datagram => (int)datagram.Number)); // up there are acknowledgements only
        Assert.Equal(hasTransfer ? 0 : 1, Drain(clients[0]).Count);
        clock.Now += SimDuration.FromSeconds(3);
        Turn();
        Assert.Equal(hasTransfer ? 1 : 0, Drain(clients[0]).Count);
    }

    [Fact]
    public void Poll_OneClientTooMany_IsRefusedAndTheOthersGoOn()
    {
        Relay(LinkProfiles.PureDelay(0));
        foreach (IDatagramPort client in clients)
        {
            Send(client, 1);
            Send(client, 2);
        }

        Turn();
        Assert.Equal(2 * MaxClients, Drain(host).Count);
        Assert.Equal(new RelayTraffic(MaxClients, 2 * MaxClients, 0, 0, 0, 2), relay!.Traffic);
        Send(clients[0], 3);
        Turn();
        Assert.Equal(3, Assert.Single(Drain(host)).Number);
    }

    [Fact]
    public void Poll_WithChangingPorts_TheHostSeesAClientElsewhereAndWhatGoesToItsFormerPortIsLost()
    {
        Relay(LinkProfiles.PureDelay(5), SimDuration.FromSeconds(10));
        Send(clients[0], 1);
        Turn();
        clock.Now = At(5);
        Turn();
        PeerAddress first = Assert.Single(Drain(host)).From;
        clock.Now = SimTime.FromSeconds(10) - SimDuration.OneTick;
        Assert.Equal(SimTime.FromSeconds(10), Turn()); // it says when it changes, though nothing is on its way
        Assert.Single(backs);
        clock.Now = SimTime.FromSeconds(10);
        Assert.Equal(SimTime.FromSeconds(20), Turn());
        Assert.Equal(2, backs.Count);
        Send(clients[0], 2);
        host.Send([9], first); // where it is no longer
        Turn();
        clock.Now += SimDuration.FromMilliseconds(5);
        Turn();
        (byte number, PeerAddress second) = Assert.Single(Drain(host));
        Assert.Equal(2, number);
        Assert.NotEqual(first, second);
        host.Send([11], second);
        Turn();
        clock.Now += SimDuration.FromMilliseconds(5);
        Turn();
        Assert.Equal([11], Drain(clients[0]).Select(datagram => datagram.Number));
        Assert.Equal((1, 1), (relay!.Traffic.Clients, relay.Traffic.PortChanges));

        relay.ChangePorts(); // or when it is told to
        Turn();
        Assert.Equal(3, backs.Count);
        Assert.Equal(2, relay.Traffic.PortChanges);
    }

    [Fact]
    public void Poll_SomebodyElseTowardsAClient_IsRefused()
    {
        Relay(LinkProfiles.PureDelay(0));
        Send(clients[0], 1);
        Turn();
        clients[1].Send([6], backs[0].LocalAddress);
        Turn();
        Assert.Empty(Drain(clients[0]));
        Assert.Equal(1, relay!.Traffic.Refused);
    }

    [Fact]
    public void Poll_NoPortToBeHad_RefusesAndAsksAgain()
    {
        Relay(LinkProfiles.PureDelay(0));
        outOfPorts = true;
        Send(clients[0], 1);
        Turn();
        Assert.Equal(new RelayTraffic(0, 0, 0, 0, 0, 1), relay!.Traffic);
        outOfPorts = false;
        Send(clients[0], 2);
        Turn();
        Assert.Equal(2, Assert.Single(Drain(host)).Number);
        Assert.Equal(new RelayTraffic(1, 1, 0, 0, 0, 1), relay.Traffic);
    }

    [Fact]
    public void Poll_MoreThanAQueueHolds_LosesTheRest()
    {
        const int TooMany = 10;
        Relay(Uneven);
        for (int i = 0; i < HeldDatagrams.MaxHeld + TooMany; i++)
        {
            Send(clients[0], 1);
        }

        Turn();
        Assert.Equal(TooMany, relay!.Traffic.LostToHost);
        clock.Now = At(10);
        Turn();
        Assert.Equal(HeldDatagrams.MaxHeld, relay.Traffic.ForwardedToHost);
    }

    [Fact]
    public void Dispose_WithClients_ClosesEveryPort()
    {
        Relay(Uneven);
        Send(clients[0], 1);
        Turn();
        relay!.Dispose();
        network.CreatePort(Front).Dispose(); // refused while the relay has it
        network.CreatePort(FirstBack).Dispose();
    }

    private static SimTime At(double milliseconds) => SimTime.Zero + SimDuration.FromMilliseconds(milliseconds);

    private void Relay(LinkProfile profile, SimDuration? change = null) => relay = new RelayCore(
        network.CreatePort(Front), host.LocalAddress, profile, 1, MaxClients, () =>
        {
            if (outOfPorts)
            {
                return null;
            }

            backs.Add(network.CreatePort(FirstBack + backs.Count));
            return backs[^1];
        },
        change);

    private void Send(IDatagramPort client, byte number)
    {
        client.Send([number], PeerAddress.Virtual(Front));
        network.DeliverUntil(clock.Now);
    }

    /// <summary>Lets the relay act now, with what has been sent until now, and lets what it sends arrive.</summary>
    private SimTime? Turn()
    {
        network.DeliverUntil(clock.Now);
        SimTime? next = relay!.Poll(clock.Now);
        network.DeliverUntil(clock.Now);
        return next;
    }

    private (byte Number, PeerAddress From)? TurnAt(SimTime time, IDatagramPort receiver)
    {
        clock.Now = time;
        Turn();
        return Drain(receiver).Select(datagram => ((byte, PeerAddress)?)datagram).SingleOrDefault();
    }

    private List<(byte Number, PeerAddress From)> Drain(IDatagramPort port)
    {
        List<(byte, PeerAddress)> all = [];
        while (port.TryReceive(buffer, out _, out PeerAddress from))
        {
            all.Add((buffer[0], from));
        }

        return all;
    }
}
