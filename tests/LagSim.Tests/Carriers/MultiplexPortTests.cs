using System;
using System.Collections.Generic;
using System.Net;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>Two carriers as one: each address goes to its own, and neither waits for the other.</summary>
public sealed class MultiplexPortTests
{
    private static readonly PeerAddress EndPoint = PeerAddress.From(new IPEndPoint(IPAddress.Loopback, 5)), Connection = PeerAddress.OfConnection(IPAddress.Loopback, 4);

    [Fact]
    public void Send_ByTheKindOfItsAddress_GoesToOneOfThem()
    {
        Kept datagrams = new(), connections = new();
        using MultiplexPort port = new(datagrams, connections);
        port.Send([1], EndPoint);
        port.Send([2], Connection);
        Assert.Equal([EndPoint], datagrams.Sent);
        Assert.Equal([Connection], connections.Sent);
        port.NoteSeated(Connection);
        port.NoteSeated(EndPoint);
        Assert.Equal([EndPoint], datagrams.Seated);
        Assert.Equal([Connection], connections.Seated);
    }

    [Fact]
    public void TryReceive_BothAreFull_TakesFromThemInTurn()
    {
        Kept datagrams = new() { Waiting = 5 }, connections = new() { Waiting = 2 };
        using MultiplexPort port = new(datagrams, connections);
        int arrived = 0;
        port.Arrived += () => arrived++;
        datagrams.Tell();
        connections.Tell();
        Assert.Equal(2, arrived);

        List<int> left = [];
        while (port.TryReceive(new byte[IDatagramPort.MaxDatagramBytes], out _, out _))
        {
            left.Add((10 * datagrams.Waiting) + connections.Waiting);
        }

        Assert.Equal([51, 41, 40, 30, 20, 10, 0], left);
        port.Dispose();
        Assert.True(datagrams.IsDisposed && connections.IsDisposed);
    }

    [Fact]
    public void Address_OfAConnection_IsNoEndPointAndHasItsMachine()
    {
        PeerAddress same = PeerAddress.From(new IPEndPoint(IPAddress.Loopback, 4)), six = PeerAddress.OfConnection(IPAddress.IPv6Loopback, 65535);
        Assert.NotEqual(same, Connection);
        Assert.False(same.IsConnection);
        Assert.Equal(same.Machine, Connection.Machine);
        Assert.Equal(PeerAddress.From(new IPEndPoint(IPAddress.IPv6Loopback, 1)).Machine, six.Machine);
        Assert.Equal(("127.0.0.1#4", "::1#65535"), (Connection.ToString(), six.ToString()));
        Assert.Equal((IPAddress.Loopback, IPAddress.IPv6Loopback), (Connection.ToIPAddress(), six.ToIPAddress()));
        Assert.Contains("127.0.0.1#4", Assert.Throws<InvalidOperationException>(() => Connection.ToEndPoint()).Message, StringComparison.Ordinal);
        Assert.Throws<InvalidOperationException>(() => PeerAddress.Virtual(1).ToIPAddress());
        Assert.Throws<ArgumentNullException>(() => PeerAddress.OfConnection(null!, 1));
    }

    private sealed class Kept : IDatagramPort
    {
        public event Action? Arrived;

        public PeerAddress LocalAddress => default;

        internal List<PeerAddress> Sent { get; } = [];

        internal List<PeerAddress> Seated { get; } = [];

        internal int Waiting { get; set; }

        internal bool IsDisposed { get; private set; }

        public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => Sent.Add(to);

        public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
        {
            (length, from) = (1, default);
            return Waiting > 0 && Waiting-- > 0;
        }

        public void NoteSeated(PeerAddress peer) => Seated.Add(peer);

        public void Dispose() => IsDisposed = true;

        internal void Tell() => Arrived?.Invoke();
    }
}
