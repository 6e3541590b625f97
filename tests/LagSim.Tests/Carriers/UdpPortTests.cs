using System;
using System.Net;
using System.Net.Sockets;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>What is UDP's alone; the rest is in <see cref="UdpPortSuiteTests"/>.</summary>
public class UdpPortTests
{
    [Fact]
    public void Counters_OfAnUndisturbedExchange_StayZero()
    {
        using PortEnd a = new(Loopback()), b = new(Loopback());

        Assert.Equal(new byte[] { 7 }, a.Deliver([7], b)); // at once, without a greeting
        Assert.Equal(new byte[] { 8 }, b.Deliver([8], a));
        UdpPort first = (UdpPort)a.Port, second = (UdpPort)b.Port;
        Assert.Equal(0, first.Dropped + second.Dropped + first.SendFailures + second.SendFailures + first.ReceiveFailures + second.ReceiveFailures);
    }

    [Fact]
    public void Receive_OversizeAndEmpty_AreDroppedAndCounted()
    {
        using PortEnd port = new(Loopback()), good = new(Loopback());
        using Socket stranger = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
        stranger.SendTo(new byte[IDatagramPort.MaxDatagramBytes + 1], port.Address.ToEndPoint());
        stranger.SendTo(new byte[4000], port.Address.ToEndPoint());
        stranger.SendTo(Array.Empty<byte>(), port.Address.ToEndPoint());

        Assert.Equal(new byte[] { 9 }, good.Deliver([9], port)); // loopback keeps order: the others are through
        Assert.Equal(3, ((UdpPort)port.Port).Dropped);
    }

    [Fact]
    public void Send_NetworkRefuses_IsCounted()
    {
        using UdpPort port = Loopback();

        port.Send(new byte[] { 1 }, PeerAddress.From(new IPEndPoint(IPAddress.IPv6Loopback, 9))); // an IPv4 port cannot
        port.Send(new byte[] { 1 }, PeerAddress.From(new IPEndPoint(IPAddress.Broadcast, 9))); // not permitted

        Assert.Equal(2, port.SendFailures);
    }

    private static UdpPort Loopback() => new(new IPEndPoint(IPAddress.Loopback, 0));
}
