using System;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

public class UdpPortTests
{
    private static readonly TimeSpan Deadline = TimeSpan.FromSeconds(10);

    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];

    [Fact]
    public void Send_BetweenTwoPorts_ArrivesBothWaysWholeAndWithTheSender()
    {
        using UdpPort a = Loopback(), b = Loopback();
        byte[] longest = Enumerable.Range(0, IDatagramPort.MaxDatagramBytes).Select(i => (byte)i).ToArray();

        Assert.Equal(longest, Deliver(a, b, longest));
        Assert.Equal(new byte[] { 7 }, Deliver(b, a, new byte[] { 7 }));
        Assert.False(a.TryReceive(buffer, out _, out _));
        Assert.Equal(0, a.Dropped + b.Dropped + a.SendFailures + b.SendFailures);
    }

    [Fact]
    public void LocalAddress_BoundToAnyAndPortZero_IsReachableOnThisMachine()
    {
        using UdpPort any = new(new IPEndPoint(IPAddress.Any, 0));
        using UdpPort other = Loopback();

        Assert.Equal(IPAddress.Loopback, any.LocalAddress.ToEndPoint().Address);
        Assert.NotEqual(0, any.LocalAddress.ToEndPoint().Port);
        Assert.Equal(new byte[] { 1, 2 }, Deliver(other, any, new byte[] { 1, 2 }));
    }

    [Fact]
    public void Constructor_PortInUse_NamesTheEndpoint()
    {
        using UdpPort first = Loopback();
        IPEndPoint taken = first.LocalAddress.ToEndPoint();

        IOException failure = Assert.Throws<IOException>(() => new UdpPort(taken));

        Assert.Contains(taken.ToString(), failure.Message, StringComparison.Ordinal);
        Assert.Equal(SocketError.AddressAlreadyInUse, Assert.IsType<SocketException>(failure.InnerException).SocketErrorCode);
    }

    [Fact]
    public void Send_EmptyOversizeOrNowhere_IsRefused()
    {
        using UdpPort port = Loopback();

        Assert.Throws<ArgumentException>(() => port.Send(default, port.LocalAddress));
        Assert.Throws<ArgumentException>(() => port.Send(new byte[IDatagramPort.MaxDatagramBytes + 1], port.LocalAddress));
        Assert.Throws<ArgumentException>(() => port.Send(new byte[1], default));
        Assert.Throws<ArgumentException>(() => port.Send(new byte[1], PeerAddress.Virtual(3)));
        Assert.Throws<ArgumentException>(() => port.TryReceive(new byte[IDatagramPort.MaxDatagramBytes - 1], out _, out _));
    }

    [Fact]
    public void Receive_OversizeAndEmpty_AreDroppedAndCounted()
    {
        using UdpPort port = Loopback();
        using Socket stranger = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
        stranger.SendTo(new byte[IDatagramPort.MaxDatagramBytes + 1], port.LocalAddress.ToEndPoint());
        stranger.SendTo(new byte[4000], port.LocalAddress.ToEndPoint());
        stranger.SendTo(Array.Empty<byte>(), port.LocalAddress.ToEndPoint());
        using UdpPort good = Loopback();

        Assert.Equal(new byte[] { 9 }, Deliver(good, port, new byte[] { 9 })); // loopback keeps order: the others are through
        Assert.Equal(3, port.Dropped);
    }

    [Fact]
    public void Receive_NobodyTakes_DropsWhatTheRingDoesNotHold()
    {
        using UdpPort from = Loopback(), to = Loopback();
        using ManualResetEventSlim arrived = new();
        int count = 0;
        to.Arrived += () =>
        {
            Interlocked.Increment(ref count);
            arrived.Set();
        };
        for (int i = 1; i <= UdpPort.RingSlots; i++)
        {
            from.Send(new[] { (byte)i }, to.LocalAddress);
            while (Volatile.Read(ref count) < i)
            {
                Assert.True(arrived.Wait(Deadline, TestContext.Current.CancellationToken), $"Datagram {i} did not arrive.");
                arrived.Reset();
            }
        }

        from.Send(new byte[] { 1 }, to.LocalAddress);
        Assert.True(SpinWait.SpinUntil(() => to.Dropped == 1, Deadline));
        for (int i = 1; i <= UdpPort.RingSlots; i++)
        {
            Assert.True(to.TryReceive(buffer, out int length, out _));
            Assert.Equal((1, (byte)i), (length, buffer[0]));
        }

        Assert.False(to.TryReceive(buffer, out _, out _));
    }

    [Fact]
    public void Send_NobodyListens_NeverThrowsAndThePortStaysUsable()
    {
        using UdpPort port = Loopback(), other = Loopback();
        PeerAddress gone;
        using (UdpPort closed = Loopback())
        {
            gone = closed.LocalAddress;
        }

        for (int i = 0; i < 20; i++)
        {
            port.Send(new byte[] { 1 }, gone);
        }

        Assert.Equal(new byte[] { 5 }, Deliver(other, port, new byte[] { 5 }));
        Assert.Equal(new byte[] { 6 }, Deliver(port, other, new byte[] { 6 }));
    }

    [Fact]
    public void Send_NetworkRefuses_IsCounted()
    {
        using UdpPort port = Loopback();

        port.Send(new byte[] { 1 }, PeerAddress.From(new IPEndPoint(IPAddress.IPv6Loopback, 9))); // an IPv4 port cannot
        port.Send(new byte[] { 1 }, PeerAddress.From(new IPEndPoint(IPAddress.Broadcast, 9))); // not permitted

        Assert.Equal(2, port.SendFailures);
    }

    [Fact]
    public void Dispose_WhileItWaits_EndsItsThreadPromptlyAndFreesThePort()
    {
        UdpPort port = Loopback();
        IPEndPoint endPoint = port.LocalAddress.ToEndPoint();
        long before = Environment.TickCount64;

        port.Dispose();
        port.Dispose();

        Assert.InRange(Environment.TickCount64 - before, 0, 1500);
        Assert.Throws<ObjectDisposedException>(() => port.Send(new byte[1], PeerAddress.From(endPoint)));
        Assert.False(port.TryReceive(buffer, out _, out _));
        using UdpPort again = new(endPoint);
        Assert.Equal(endPoint, again.LocalAddress.ToEndPoint());
    }

    private static UdpPort Loopback() => new(new IPEndPoint(IPAddress.Loopback, 0));

    private byte[] Deliver(UdpPort from, UdpPort to, byte[] datagram)
    {
        using ManualResetEventSlim arrived = new();
        Action wake = arrived.Set;
        to.Arrived += wake;
        try
        {
            from.Send(datagram, to.LocalAddress);
            Assert.True(arrived.Wait(Deadline, TestContext.Current.CancellationToken), "The datagram did not arrive.");
            Assert.True(to.TryReceive(buffer, out int length, out PeerAddress sender));
            Assert.Equal(from.LocalAddress, sender);
            return buffer[..length];
        }
        finally
        {
            to.Arrived -= wake;
        }
    }
}
