using System;
using System.Linq;
using System.Net;
using System.Threading;
using LagSim.Net.Carriers;
using LiteNetLib;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>What is LiteNetLib's alone; the rest is in <see cref="LiteNetLibPortSuiteTests"/>.</summary>
[Trait("Time", "real")]
public sealed class LiteNetLibPortTests
{
    private const byte Unreliable = 0;

    [Theory]
    [InlineData(1)]
    [InlineData(1023)]
    [InlineData(1024)]
    [InlineData(IDatagramPort.MaxDatagramBytes)]
    public void Send_OnTheWire_IsOnePacketAByteLonger(int size)
    {
        using LiteNetLibPort port = Open();
        using RawLiteNetLib raw = new();
        raw.Accept(port);
        Assert.True(SpinWait.SpinUntil(() => port.Connections == 1, PortEnd.Deadline));

        byte[] datagram = Enumerable.Range(1, size).Select(i => (byte)i).ToArray();
        port.Send(datagram, raw.Address);

        Assert.Equal([Unreliable, .. datagram], raw.Take(Unreliable));
    }

    [Fact]
    public void Send_LiteNetLibsOwnLimit_IsLessThanADatagram()
    {
        // Why the port sets another: the control of the sizes above.
        EventBasedLiteNetListener listener = new();
        LiteNetManager host = new(listener) { UnsyncedEvents = true, IPv6Enabled = false }, other = new(new EventBasedLiteNetListener()) { UnsyncedEvents = true, IPv6Enabled = false };
        listener.ConnectionRequestEvent += request => request.Accept();
        try
        {
            Assert.True(host.Start(IPAddress.Loopback, IPAddress.IPv6Any, 0) && other.Start(IPAddress.Loopback, IPAddress.IPv6Any, 0));
            LiteNetPeer peer = other.Connect(new IPEndPoint(IPAddress.Loopback, host.LocalPort), "");
            Assert.True(SpinWait.SpinUntil(() => peer.ConnectionState == ConnectionState.Connected, PortEnd.Deadline));
            Assert.Equal(1023, peer.GetMaxSinglePacketSize(DeliveryMethod.Unreliable));
            Assert.Throws<TooBigPacketException>(() => peer.Send(new byte[IDatagramPort.MaxDatagramBytes], DeliveryMethod.Unreliable));
        }
        finally
        {
            other.Stop();
            host.Stop();
        }
    }

    [Fact]
    public void Send_BeforeTheConnection_IsCountedAndLost()
    {
        using LiteNetLibPort port = Open();
        using RawLiteNetLib silent = new();

        port.Send(new byte[] { 1 }, silent.Address);
        port.Send(new byte[] { 2 }, silent.Address);

        Assert.Equal((2, 0, 0), (port.Unconnected, port.SendFailures, port.Connections));
        Assert.NotEmpty(silent.Take(RawLiteNetLib.ConnectRequest));
    }

    [Fact]
    public void Send_OtherFamily_IsCountedAsAFailure()
    {
        using LiteNetLibPort port = Open();
        port.Send(new byte[] { 1 }, PeerAddress.From(new IPEndPoint(IPAddress.IPv6Loopback, 9)));
        Assert.Equal((1, 0), (port.SendFailures, port.Unconnected));
    }

    [Theory]
    [InlineData("theirs", null)]
    [InlineData(null, "ours")]
    [InlineData("theirs", "ours")]
    public void Connect_AnotherKey_IsRefusedAndNothingComesThrough(string? theirs, string? ours)
    {
        using PortEnd host = new(Open(ours)), stranger = new(Open(theirs)), friend = new(Open(ours));
        LiteNetLibPort port = (LiteNetLibPort)host.Port;

        Assert.True(SpinWait.SpinUntil(
            () =>
            {
                stranger.Send([1], host);
                return port.ConnectionsRefused >= 3; // it asks every 100 ms
            },
            PortEnd.Deadline));
        Assert.Equal(0, port.Connections);
        Assert.False(host.TryTake(out _, out _));

        friend.Meet(host); // the control
        Assert.Equal(1, port.Connections);
    }

    [Fact]
    public void Connect_NoRoom_IsRefusedUntilSomebodyLeaves()
    {
        using PortEnd host = new(Open(null, 1)), second = new(Open());
        LiteNetLibPort port = (LiteNetLibPort)host.Port;
        using (PortEnd first = new(Open()))
        {
            first.Meet(host);
            second.Send([1], host);
            Assert.True(SpinWait.SpinUntil(() => port.ConnectionsRefused >= 1, PortEnd.Deadline));
            Assert.Equal(1, port.Connections);
            Assert.Equal(new byte[] { 2 }, first.Deliver([2], host));

            // Nor does it ask somebody else then.
            long before = port.Unconnected;
            host.Send([1], second);
            Assert.Equal((before + 1, 1), (port.Unconnected, port.Manager.GetPeersCount(ConnectionState.Any)));
        }

        second.Meet(host);
        Assert.Equal(1, port.Connections);
    }

    [Fact]
    public void Dispose_OfAPeer_FreesItsConnection()
    {
        using PortEnd host = new(Open());
        using (PortEnd peer = new(Open()))
        {
            peer.Meet(host);
            Assert.Equal(1, ((LiteNetLibPort)host.Port).Connections);
        }

        Assert.True(SpinWait.SpinUntil(() => ((LiteNetLibPort)host.Port).Connections == 0, PortEnd.Deadline));
    }

    [Fact]
    public void Send_PeerBackWithoutAGoodbye_IsHeardAgain()
    {
        using PortEnd a = new(Open());
        PortEnd first = new(Open());
        a.Meet(first);
        IPEndPoint endPoint = first.Address.ToEndPoint();
        ((LiteNetLibPort)first.Port).Manager.Stop(sendDisconnectMessages: false); // as if its process had been killed
        first.Dispose();
        Assert.Equal(1, ((LiteNetLibPort)a.Port).Connections);

        using PortEnd second = new(new LiteNetLibPort(endPoint));
        a.Meet(second);
        Assert.Equal(new byte[] { 8 }, second.Deliver([8], a));
    }

    [Fact]
    public void Connect_PeerSpeaksAnotherVersionOfLiteNetLib_IsCounted()
    {
        using LiteNetLibPort port = Open();
        using RawLiteNetLib raw = new();
        port.Send(new byte[] { 0 }, raw.Address);
        raw.Take(RawLiteNetLib.ConnectRequest);

        raw.Send([RawLiteNetLib.InvalidProtocol], port.LocalAddress);

        Assert.True(SpinWait.SpinUntil(() => port.ConnectionsFailed == 1, PortEnd.Deadline));
    }

    [Fact]
    public void Receive_WhatNoPortSends_IsDroppedAndCounted()
    {
        using PortEnd host = new(Open());
        LiteNetLibPort port = (LiteNetLibPort)host.Port;
        LiteNetManager hostile = new(new EventBasedLiteNetListener()) { UnsyncedEvents = true, IPv6Enabled = false, MtuOverride = 1400 };
        try
        {
            Assert.True(hostile.Start(IPAddress.Loopback, IPAddress.IPv6Any, 0));
            LiteNetPeer peer = hostile.Connect(host.Address.ToEndPoint(), System.Text.Encoding.UTF8.GetBytes(RawLiteNetLib.Key));
            Assert.True(SpinWait.SpinUntil(() => peer.ConnectionState == ConnectionState.Connected, PortEnd.Deadline));

            peer.Send(new byte[IDatagramPort.MaxDatagramBytes + 1], DeliveryMethod.Unreliable);
            peer.Send(ReadOnlySpan<byte>.Empty, DeliveryMethod.Unreliable);
            peer.Send(new byte[] { 1 }, DeliveryMethod.ReliableOrdered);
            peer.Send(new byte[] { 2 }, DeliveryMethod.Sequenced);
            peer.Send(new byte[5000], DeliveryMethod.ReliableUnordered); // in fragments, which LiteNetLib refuses itself
            Assert.True(SpinWait.SpinUntil(() => port.Dropped == 4, PortEnd.Deadline));
            peer.Send(new byte[] { 3 }, DeliveryMethod.Unreliable); // the control

            Assert.Equal(new byte[] { 3 }, host.Take().Datagram);
            Assert.False(host.TryTake(out _, out _));
            Assert.Equal(4, port.Dropped);
        }
        finally
        {
            hostile.Stop();
        }
    }

    [Fact]
    public void Receive_MalformedPacketsOfEveryKind_NeitherConnectNorHarm()
    {
        using PortEnd host = new(Open()), good = new(Open());
        LiteNetLibPort port = (LiteNetLibPort)host.Port;
        good.Meet(host);
        using RawLiteNetLib raw = new();
        Random random = new(3);
        for (int i = 0; i < 256 * 8; i++)
        {
            byte[] packet = new byte[1 + random.Next(0, i % 2 == 0 ? 24 : 1400)];
            random.NextBytes(packet);
            packet[0] = (byte)i;
            raw.Send(packet, host.Address);
            if (i % 16 == 0)
            {
                Assert.Equal(new byte[] { 1 }, good.Deliver([1], host));
            }
        }

        byte[][] requests =
        [
            RawLiteNetLib.Request(""), RawLiteNetLib.Request("LagSim 0"), RawLiteNetLib.Request(RawLiteNetLib.Key + "\0"),
            RawLiteNetLib.Request(RawLiteNetLib.Key, protocol: 12), RawLiteNetLib.Request(RawLiteNetLib.Key, addressSize: 255),
            RawLiteNetLib.Request(RawLiteNetLib.Key, addressSize: 28), RawLiteNetLib.Request(new string('x', 1300)), RawLiteNetLib.Request(RawLiteNetLib.Key)[..18],
        ];
        foreach (byte[] request in requests)
        {
            raw.Send(request, host.Address);
        }

        Assert.Equal(new byte[] { 2 }, good.Deliver([2], host));
        Assert.Equal(1, port.Connections);
        Assert.InRange(port.ConnectionsRefused, 5, long.MaxValue);
        Assert.Equal(0, port.Dropped);
        Assert.NotNull(NetDebug.Logger); // else all this would have gone to the console

        raw.Send(RawLiteNetLib.Request(RawLiteNetLib.Key), host.Address); // the control
        Assert.True(SpinWait.SpinUntil(() => port.Connections == 2, PortEnd.Deadline));
    }

    [Fact]
    public void Receive_MalformedPacketsOverAConnection_DoNoHarm()
    {
        using PortEnd host = new(Open()), good = new(Open());
        good.Meet(host);
        using RawLiteNetLib raw = new();
        raw.Connect(host.Port);
        Random random = new(5);
        for (int i = 0; i < 256 * 32; i++)
        {
            byte[] packet = new byte[1 + random.Next(0, i % 2 == 0 ? 24 : 1400)];
            random.NextBytes(packet);
            packet[0] = (byte)i;
            for (int at = 1; at < packet.Length && i % 3 == 0; at++)
            {
                packet[at] &= 3; // small numbers pass more checks
            }

            raw.Send(packet, host.Address);
            if (i % 16 == 15)
            {
                good.Send(BitConverter.GetBytes(i), host);
                (byte[] datagram, PeerAddress from) = host.Take();
                for (; from == raw.Address; (datagram, from) = host.Take())
                {
                    Assert.InRange(datagram.Length, 1, IDatagramPort.MaxDatagramBytes);
                }

                Assert.Equal((good.Address, i), (from, BitConverter.ToInt32(datagram)));
            }
        }

        Assert.Equal(2, ((LiteNetLibPort)host.Port).Connections); // so all that was taken in by a connection, not turned away
        Assert.InRange(((LiteNetLibPort)host.Port).Dropped, 1, long.MaxValue);
    }

    [Fact(Timeout = 60_000)]
    public async System.Threading.Tasks.Task Connect_ManyComeAndGoAtOnce_NothingHangsOrStays()
    {
        using PortEnd host = new(Open());
        LiteNetLibPort port = (LiteNetLibPort)host.Port;
        await System.Threading.Tasks.Task.WhenAll(Enumerable.Range(0, 4).Select(_ => System.Threading.Tasks.Task.Run(
            () =>
            {
                for (int i = 0; i < 8; i++)
                {
                    using LiteNetLibPort peer = Open();
                    Assert.True(SpinWait.SpinUntil(
                        () =>
                        {
                            peer.Send(new byte[] { 1 }, host.Address);
                            return peer.Connections == 1;
                        },
                        PortEnd.Deadline));
                }
            },
            TestContext.Current.CancellationToken)));

        Assert.True(SpinWait.SpinUntil(() => port.Connections == 0, PortEnd.Deadline));
        using PortEnd last = new(Open());
        last.Meet(host);
    }

    [Fact]
    public void Constructor_BadArguments_AreNamed()
    {
        IPEndPoint bind = new(IPAddress.Loopback, 0);
        Assert.Contains("'[::1]:0'", Assert.Throws<ArgumentException>(() => new LiteNetLibPort(new IPEndPoint(IPAddress.IPv6Loopback, 0))).Message, StringComparison.Ordinal);
        Assert.Contains("this one has 0", Assert.Throws<ArgumentException>("key", () => new LiteNetLibPort(bind, "")).Message, StringComparison.Ordinal);
        Assert.Contains("this one has 101", Assert.Throws<ArgumentException>("key", () => new LiteNetLibPort(bind, new string('x', 101))).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentOutOfRangeException>("maxConnections", () => new LiteNetLibPort(bind, null, 0));
        Assert.Throws<ArgumentOutOfRangeException>("maxConnections", () => new LiteNetLibPort(bind, null, LiteNetLibPort.MaxConnections + 1));
        using LiteNetLibPort most = new(bind, new string('\u20AC', LiteNetLibPort.MaxKeyLength), LiteNetLibPort.MaxConnections);
        Assert.NotEqual(0, most.LocalAddress.ToEndPoint().Port);
    }

    private static LiteNetLibPort Open(string? key = null, int maxConnections = LiteNetLibPort.DefaultMaxConnections) =>
        new(new IPEndPoint(IPAddress.Loopback, 0), key, maxConnections);
}
