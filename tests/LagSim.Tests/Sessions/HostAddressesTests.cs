using System;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading.Tasks;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Sessions;

/// <summary>A host of several addresses is asked at one after the other, and joined at the first that answers (RFC 8305).</summary>
public sealed class HostAddressesTests
{
    private const int Other = 50;

    private static readonly PeerAddress TheHost = PeerAddress.Virtual(0);
    private static readonly PeerAddress Nobody = PeerAddress.Virtual(Other);

    [Theory]
    [InlineData(0, 0)]
    [InlineData(1, 0.36)] // a quarter of a second for each that does not answer, and up to a pause between two tries
    [InlineData(3, 0.86)]
    public void Join_WhereTheFirstAddressesAreDead_TakesAQuarterOfASecondForEach(int dead, double most)
    {
        SimDuration alone = TimeToJoin(TheHost);
        PeerAddress[] all = [.. Enumerable.Range(0, dead).Select(n => PeerAddress.Virtual(Other + n)), TheHost];
        SimDuration extra = TimeToJoin(all) - alone;
        Assert.InRange(extra.ToSeconds(), dead * 0.25, most);
    }

    [Fact]
    public void Join_AtADeadAddressAlone_EndsWithoutAnAnswer()
    {
        SessionGroup group = new(BuiltInScenes.Pair(), 1, LinkProfiles.Lan);
        ClientSession client = group.Join(1, 7, new ClientOptions { Timeout = SimDuration.FromSeconds(2) }, Nobody);
        Assert.True(group.RunUntil(() => client.State == SessionState.Ended));
        Assert.Equal("No answer from the host within 2 s.", client.EndReason);
    }

    [Theory]
    [InlineData("lan", 0)]
    [InlineData("satellite", 3)] // a round trip of 650 ms: the second address is asked meanwhile, and no longer once the first has answered
    public void Join_WhereTheFirstAddressAnswers_AsksTheSecondOnlyUntilThen(string link, int least)
    {
        SessionGroup group = new(BuiltInScenes.Pair(), 1, LinkProfiles.Get(link));
        using IDatagramPort second = group.Network.CreatePort(Other);
        ClientSession client = group.Join(1, 7, new ClientOptions { OtherAddresses = [Nobody] });
        Assert.True(group.RunUntil(() => client.State != SessionState.Joining));
        group.Run(1); // what is on its way
        int asked = Received(second);
        Assert.InRange(asked, least, least == 0 ? 0 : 10);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running));
        group.Run(3);
        Assert.Equal(0, Received(second));
        Assert.Equal(TheHost, client.HostAddress);
    }

    /// <summary>At the first address there is a host, but not the one that is wanted: only who proves to be it is chosen.</summary>
    [Fact]
    public void Join_WhereAnotherHostIsAtTheFirstAddress_IsInAtTheWanted()
    {
        using HostIdentity wanted = HostIdentity.Draw(), other = HostIdentity.Draw();
        SessionGroup group = new(BuiltInScenes.Pair(), 1, LinkProfiles.Lan, options: _ => new HostOptions { Protection = new SecureHost(wanted) });
        IDatagramPort port = group.Network.CreatePort(Other);
        group.Steps.Add(new HostSession(BuiltInScenes.Pair(), port, group.Clock, new HostOptions { Protection = new SecureHost(other) }, 9), port);
        ClientSession client = group.Join(1, 7, new ClientOptions { Protection = new SecureClient(wanted.Fingerprint), OtherAddresses = [TheHost] }, Nobody);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running), client.EndReason);
        Assert.Equal(TheHost, client.HostAddress);

        // The control: whoever trusts the first that answers is in there.
        ClientSession trusting = group.Join(2, 8, new ClientOptions { Protection = SecureClient.TrustOnFirstUse(), OtherAddresses = [TheHost] }, Nobody);
        Assert.True(group.RunUntil(() => trusting.State == SessionState.Running), trusting.EndReason);
        Assert.Equal(Nobody, trusting.HostAddress);
    }

    /// <summary>Both loopback addresses by one port, over real sockets: whichever the host listens on.</summary>
    [Theory]
    [InlineData("127.0.0.1", "::1")]
    [InlineData("::1", "127.0.0.1")]
    [Trait("Time", "real")]
    public async Task Join_ByBothKinds_IsInByTheOneThatAnswers(string listening, string silent)
    {
        Assert.SkipUnless(Socket.OSSupportsIPv6 && HasIPv6Loopback(), "This machine has no IPv6.");
        using PeerThread host = PeerThread.Host(BuiltInScenes.Pair(), bind: IPAddress.Parse(listening));
        IPEndPoint there = host.LocalAddress.ToEndPoint();
        PeerAddress first = PeerAddress.From(new IPEndPoint(IPAddress.Parse(silent), there.Port));
        UdpPort port = new(UdpDestination.Facing(IPAddress.Parse(silent), there.Address));
        using PeerThread client = PeerThread.Join(port, first, new ClientOptions { OtherAddresses = [host.LocalAddress] });
        Assert.True(client.WaitUntilRunning(TimeSpan.FromSeconds(30)), client.Session.EndReason);
        Assert.Equal(host.LocalAddress, await client.Ask(session => session.Links.Single().Address));
    }

    [Fact]
    [Trait("Time", "real")]
    public void Join_WhereNobodyAnswers_NamesAllThatWereAsked()
    {
        using UdpPort one = new(new IPEndPoint(IPAddress.Loopback, 0)), two = new(new IPEndPoint(IPAddress.Loopback, 0));
        ClientOptions options = new() { OtherAddresses = [two.LocalAddress], Timeout = SimDuration.FromSeconds(0.4), Warmup = false };
        using PeerThread client = PeerThread.Join(new UdpPort(new IPEndPoint(IPAddress.Loopback, 0)), one.LocalAddress, options);
        Assert.False(client.WaitUntilRunning(TimeSpan.FromSeconds(30)));
        Assert.Equal($"No answer from the host at {one.LocalAddress} or {two.LocalAddress} within 0.4 s.", client.Session.EndReason);
        Assert.InRange(Received(one), 3, int.MaxValue);
        Assert.InRange(Received(two), 1, int.MaxValue);
    }

    private static SimDuration TimeToJoin(params PeerAddress[] addresses)
    {
        SessionGroup group = new(BuiltInScenes.Pair(), 1, LinkProfiles.Lan);
        group.Run(1);
        SimTime began = group.Clock.Now;
        ClientSession client = group.Join(1, 7, new ClientOptions { OtherAddresses = addresses[1..] }, addresses[0]);
        Assert.True(group.RunUntil(() => client.State == SessionState.Running));
        return group.Clock.Now - began;
    }

    private static int Received(IDatagramPort port)
    {
        byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
        int count = 0;
        while (port.TryReceive(buffer, out _, out _))
        {
            count++;
        }

        return count;
    }

    private static bool HasIPv6Loopback()
    {
        try
        {
            using Socket socket = new(AddressFamily.InterNetworkV6, SocketType.Dgram, ProtocolType.Udp);
            socket.Bind(new IPEndPoint(IPAddress.IPv6Loopback, 0));
            return true;
        }
        catch (SocketException)
        {
            return false;
        }
    }
}
