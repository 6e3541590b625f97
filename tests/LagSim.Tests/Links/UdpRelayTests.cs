using System;
using System.IO;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Harness.Relays;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>The relay over real sockets: that it works, not how fast.</summary>
[Trait("Time", "real")]
public sealed class UdpRelayTests : IDisposable
{
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(30);
    private static readonly IPEndPoint AnyFreePort = new(IPAddress.Loopback, 0);

    private readonly StopwatchClock clock = new();
    private readonly UdpPort host = new(AnyFreePort);
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];

    public void Dispose() => host.Dispose();

    [Fact]
    public void Relay_TwoClients_ReachTheHostByTwoAddressesAndHearItsAnswers()
    {
        using UdpRelay relay = Relay(new LinkProfile("uneven", toHost: new LinkLeg(20), fromHost: new LinkLeg(5)));
        using UdpPort first = new(AnyFreePort), second = new(AnyFreePort);
        SimTime sent = clock.Now;
        first.Send([1, 2, 3], relay.LocalAddress);
        (byte[] datagram, PeerAddress firstSeen) = Receive(host);
        Assert.Equal(new byte[] { 1, 2, 3 }, datagram);

        // No upper bound: a busy machine may be late. The lower one is exact.
        Assert.True(clock.Now - sent >= SimDuration.FromMilliseconds(20));
        second.Send([4], relay.LocalAddress);
        (datagram, PeerAddress secondSeen) = Receive(host);
        Assert.Equal(new byte[] { 4 }, datagram);
        Assert.Equal(4, new[] { firstSeen, secondSeen, first.LocalAddress, second.LocalAddress }.Distinct().Count());

        host.Send([5], firstSeen);
        host.Send([6], secondSeen);
        (byte[] toSecond, PeerAddress from) = Receive(second);
        (byte[] toFirst, _) = Receive(first);
        Assert.Equal((5, 6, relay.LocalAddress), (toFirst.Single(), toSecond.Single(), from));
        Assert.Equal(new RelayTraffic(2, 2, 0, 2, 0, 0), Settled(relay, traffic => traffic.ForwardedFromHost == 2));
    }

    [Fact]
    public void Relay_ProfileThatLosesEverything_PassesNothing()
    {
        using UdpRelay relay = Relay(new LinkProfile("dead", new LinkLeg(0, lossPercent: 100)));
        using UdpPort client = new(AnyFreePort);
        for (int i = 0; i < 20; i++)
        {
            client.Send([1], relay.LocalAddress);
        }

        Settled(relay, traffic => traffic.LostToHost == 20);
        Assert.False(host.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void Relay_MoreClientsThanThereCanBe_RefusesTheRest()
    {
        using UdpRelay relay = Relay(LinkProfiles.PureDelay(0));
        UdpPort[] clients = Enumerable.Range(0, UdpRelay.MaxClients + 2).Select(_ => new UdpPort(AnyFreePort)).ToArray();
        for (int n = 0; n < clients.Length; n++)
        {
            clients[n].Send([1], relay.LocalAddress);
            int heard = n + 1;
            Settled(relay, traffic => traffic.Clients + traffic.Refused == heard);
        }

        Assert.Equal(new RelayTraffic(UdpRelay.MaxClients, UdpRelay.MaxClients, 0, 0, 0, 2), relay.Traffic);
        Array.ForEach(clients, client => client.Dispose());
    }

    [Fact]
    public void Relay_BetweenSessions_LetsClientsIn()
    {
        using UdpRelay relay = Relay(LinkProfiles.PureDelay(5));
        using UdpPort first = new(AnyFreePort), second = new(AnyFreePort);
        using PeerThread hosting = new(
            new HostSession(BuiltInScenes.Pair(), host, clock, new HostOptions { ExpectedClients = 2 }, 7), host, "host");
        PeerThread[] joining = new[] { first, second }
            .Select(port => new PeerThread(new ClientSession(BuiltInScenes.Pair(), port, clock, new ClientOptions(), relay.LocalAddress, 7), port, "joiner"))
            .ToArray();
        hosting.Start();
        Array.ForEach(joining, thread => thread.Start());
        Assert.True(SpinWait.SpinUntil(() => joining.All(thread => thread.Session.World is not null), Deadline));
        Assert.Equal([1, 2], joining.Select(thread => (int)thread.Session.Peer).Order());
        Array.ForEach(joining, thread => thread.Dispose());
        Assert.Equal((2, 0L), (relay.Traffic.Clients, relay.Traffic.Refused));
    }

    [Fact]
    public void Dispose_WithMuchOnItsWay_EndsPromptlyAndFreesThePort()
    {
        UdpRelay relay = Relay(new LinkProfile("slow", new LinkLeg(600_000)));
        using UdpPort client = new(AnyFreePort);
        client.Send([1], relay.LocalAddress);
        Settled(relay, traffic => traffic.Clients == 1);
        Thread disposer = new(relay.Dispose) { IsBackground = true };
        disposer.Start();
        Assert.True(disposer.Join(Deadline));
        relay.Dispose();
        using UdpPort again = new(relay.LocalAddress.ToEndPoint());
        Assert.Equal(relay.LocalAddress, again.LocalAddress);
    }

    [Fact]
    public void Constructor_NoHostOrPortInUse_IsRefused()
    {
        foreach (IPEndPoint nobody in new IPEndPoint[] { new(IPAddress.Loopback, 0), new(IPAddress.Any, 9), new(IPAddress.IPv6Any, 9) })
        {
            ArgumentException refused = Assert.Throws<ArgumentException>(() => new UdpRelay(AnyFreePort, nobody, LinkProfiles.Lan, 1, clock));
            Assert.Contains($"'{nobody}'", refused.Message, StringComparison.Ordinal);
        }

        IPEndPoint taken = host.LocalAddress.ToEndPoint();
        Assert.Throws<IOException>(() => new UdpRelay(taken, taken, LinkProfiles.Lan, 1, clock));
    }

    [Theory]
    [InlineData("127.0.0.1", "127.0.0.1", true)]
    [InlineData("0.0.0.0", "127.0.0.1", true)]
    [InlineData("127.0.0.1", "::ffff:127.0.0.1", true)]
    [InlineData("127.0.0.1", "127.0.0.2", false)] // another address, where somebody else may listen
    [InlineData("0.0.0.0", "203.0.113.7", false)] // another machine
    public void Constructor_ToItsOwnAddress_IsRefused(string listen, string to, bool isOwn)
    {
        int port;
        using (UdpPort free = new(AnyFreePort))
        {
            port = free.LocalAddress.ToEndPoint().Port;
        }

        IPEndPoint here = new(IPAddress.Parse(listen), port), there = new(IPAddress.Parse(to), port);
        for (int n = 0; n < 2; n++)
        {
            if (isOwn)
            {
                ArgumentException refused = Assert.Throws<ArgumentException>(() => new UdpRelay(here, there, LinkProfiles.Lan, 1, clock)); // twice: the port was given back
                Assert.Contains($"'{there}' is the relay's own address", refused.Message, StringComparison.Ordinal);
            }
            else
            {
                new UdpRelay(here, there, LinkProfiles.Lan, 1, clock).Dispose();
            }
        }
    }

    private UdpRelay Relay(LinkProfile profile) => new(AnyFreePort, host.LocalAddress.ToEndPoint(), profile, 1, clock);

    private static RelayTraffic Settled(UdpRelay relay, Func<RelayTraffic, bool> condition)
    {
        Assert.True(SpinWait.SpinUntil(() => condition(relay.Traffic), Deadline), relay.Traffic.ToString());
        return relay.Traffic;
    }

    private (byte[] Datagram, PeerAddress From) Receive(UdpPort port)
    {
        using ManualResetEventSlim arrived = new();
        port.Arrived += arrived.Set;
        int length;
        PeerAddress from;
        while (!port.TryReceive(buffer, out length, out from))
        {
            Assert.True(arrived.Wait(Deadline, TestContext.Current.CancellationToken), "Nothing arrived.");
            arrived.Reset();
        }

        port.Arrived -= arrived.Set;
        return (buffer[..length], from);
    }
}
