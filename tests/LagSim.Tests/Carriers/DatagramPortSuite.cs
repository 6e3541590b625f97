using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>What every carrier must do, as <see cref="IDatagramPort"/> says. A carrier that may lose what comes before a connection is met first.</summary>
public abstract class DatagramPortSuite
{
    [Fact]
    public void Send_BetweenTwoPorts_ArrivesBothWaysWholeAndWithTheSender()
    {
        using PortEnd a = Loopback(), b = Loopback();
        a.Meet(b);

        byte[] longest = Pattern(IDatagramPort.MaxDatagramBytes);
        Assert.Equal(longest, a.Deliver(longest, b));
        Assert.Equal(new byte[] { 7 }, b.Deliver([7], a));
        Assert.False(a.TryTake(out _, out _));
        Assert.False(b.TryTake(out _, out _));
    }

    [Fact]
    public void Send_EverySizeThereIs_ArrivesWhole()
    {
        using PortEnd a = Loopback(), b = Loopback();
        a.Meet(b);

        for (int size = 1; size <= IDatagramPort.MaxDatagramBytes; size++)
        {
            byte[] datagram = Pattern(size);
            byte[] arrived = a.Deliver(datagram, b);
            Assert.True(datagram.AsSpan().SequenceEqual(arrived), $"{size} bytes came as {arrived.Length}, or differ.");
        }
    }

    [Fact]
    public void Send_EmptyOversizeOrNowhere_IsRefused()
    {
        using PortEnd a = Loopback(), b = Loopback();

        Assert.Contains("this one has 0", Refused(() => a.Port.Send(default, b.Address)), StringComparison.Ordinal);
        Assert.Contains("1201", Refused(() => a.Port.Send(new byte[IDatagramPort.MaxDatagramBytes + 1], b.Address)), StringComparison.Ordinal);
        Assert.Contains("'none'", Refused(() => a.Port.Send(new byte[1], default)), StringComparison.Ordinal);
        Assert.Contains("'virtual:3'", Refused(() => a.Port.Send(new byte[1], PeerAddress.Virtual(3))), StringComparison.Ordinal);
        Assert.Contains("1199", Refused(() => a.Port.TryReceive(new byte[IDatagramPort.MaxDatagramBytes - 1], out _, out _)), StringComparison.Ordinal);

        a.Meet(b); // and again where a connection stands
        Assert.Contains("1201", Refused(() => a.Port.Send(new byte[IDatagramPort.MaxDatagramBytes + 1], b.Address)), StringComparison.Ordinal);
        Assert.Equal(new byte[] { 1 }, a.Deliver([1], b));
    }

    [Fact]
    public void Send_ManyDatagrams_ArriveOnceEach()
    {
        const int window = 64; // as many as the smallest receive buffer of a system holds of the longest
        using PortEnd a = Loopback(), b = Loopback();
        a.Meet(b);

        for (int first = 0; first < 100 * window; first += window)
        {
            List<int> numbers = Enumerable.Range(first, window).ToList();
            foreach (int number in numbers)
            {
                byte[] datagram = Pattern(4 + (number * 37 % (IDatagramPort.MaxDatagramBytes - 3)));
                BitConverter.TryWriteBytes(datagram, number);
                a.Send(datagram, b);
            }

            for (int i = 0; i < window; i++)
            {
                byte[] datagram = b.Take().Datagram;
                int number = BitConverter.ToInt32(datagram);
                Assert.True(numbers.Remove(number), $"{number} came twice or was never sent.");
                Assert.Equal(4 + (number * 37 % (IDatagramPort.MaxDatagramBytes - 3)), datagram.Length);
            }
        }

        Assert.False(b.TryTake(out _, out _));
        Assert.Equal(0, Dropped(b.Port));
    }

    [Fact]
    public void Receive_NobodyTakes_DropsWhatTheRingDoesNotHold()
    {
        using PortEnd from = Loopback(), to = Loopback();
        from.Meet(to);
        using ManualResetEventSlim arrived = new();
        int count = 0;
        to.Port.Arrived += () =>
        {
            Interlocked.Increment(ref count);
            arrived.Set();
        };
        for (int i = 1; i <= RingSlots; i++)
        {
            from.Send([(byte)i], to);
            while (Volatile.Read(ref count) < i)
            {
                Assert.True(arrived.Wait(PortEnd.Deadline, TestContext.Current.CancellationToken), $"Datagram {i} did not arrive.");
                arrived.Reset();
            }
        }

        Assert.Equal(0, Dropped(to.Port));
        from.Send([1], to);
        Assert.True(SpinWait.SpinUntil(() => Dropped(to.Port) == 1, PortEnd.Deadline));
        for (int i = 1; i <= RingSlots; i++)
        {
            Assert.True(to.TryTake(out byte[] datagram, out _));
            Assert.Equal([(byte)i], datagram);
        }

        Assert.False(to.TryTake(out _, out _));
    }

    [Fact]
    public void Send_TwoPeersToOneHost_AreToldApart()
    {
        using PortEnd host = Loopback(), a = Loopback(), b = Loopback();
        a.Meet(host);
        b.Meet(host);

        for (byte i = 0; i < 10; i++)
        {
            Assert.Equal(new byte[] { 1, i }, a.Deliver([1, i], host)); // Deliver asserts the sender
            Assert.Equal(new byte[] { 2, i }, b.Deliver([2, i], host));
            Assert.Equal(new byte[] { 3, i }, host.Deliver([3, i], a));
            Assert.Equal(new byte[] { 4, i }, host.Deliver([4, i], b));
        }

        Assert.All([host, a, b], end => Assert.False(end.TryTake(out _, out _)));
    }

    [Fact]
    public void Send_BothBegin_BothAreHeard()
    {
        using PortEnd a = Loopback(), b = Loopback();
        a.Send([0], b);
        b.Send([0], a);

        a.Meet(b);
        b.Meet(a);
        Assert.Equal(new byte[] { 5 }, a.Deliver([5], b));
        Assert.Equal(new byte[] { 6 }, b.Deliver([6], a));
    }

    [Fact]
    public void Send_NobodyListens_NeverThrowsAndThePortStaysUsable()
    {
        using PortEnd port = Loopback(), other = Loopback();
        PeerAddress gone;
        using (PortEnd closed = Loopback())
        {
            gone = closed.Address;
        }

        for (int i = 0; i < 20; i++)
        {
            port.Port.Send(new byte[] { 1 }, gone);
        }

        port.Meet(other);
        Assert.Equal(new byte[] { 5 }, other.Deliver([5], port));
        Assert.Equal(new byte[] { 6 }, port.Deliver([6], other));
    }

    [Fact]
    public void Send_PeerGoneAndBackAtItsAddress_IsHeardAgain()
    {
        using PortEnd a = Loopback();
        PortEnd first = Loopback();
        a.Meet(first);
        IPEndPoint endPoint = first.Address.ToEndPoint();
        first.Dispose();

        a.Port.Send(new byte[] { 1 }, PeerAddress.From(endPoint)); // to nobody
        using PortEnd second = new(Open(endPoint));
        a.Meet(second);
        Assert.Equal(new byte[] { 8 }, second.Deliver([8], a));
    }

    [Fact]
    public void Receive_GarbageFromARawSocket_DoesNoHarm()
    {
        using PortEnd host = Loopback(), good = Loopback();
        good.Meet(host);
        using Socket raw = new(AddressFamily.InterNetwork, SocketType.Dgram, ProtocolType.Udp);
        raw.Bind(new IPEndPoint(IPAddress.Loopback, 0));
        PeerAddress stranger = PeerAddress.From((IPEndPoint)raw.LocalEndPoint!);
        Random random = new(7);
        byte[] garbage = new byte[4000];
        for (int i = 0; i < 4096; i++)
        {
            random.NextBytes(garbage);
            garbage[0] = (byte)i; // every first byte, which is what a carrier goes by
            int length = i % 50 == 0 ? garbage.Length : random.Next(0, i % 2 == 0 ? 40 : 1500);
            raw.SendTo(garbage, length, SocketFlags.None, host.Address.ToEndPoint());
            if (i % 16 == 15)
            {
                byte[] mark = BitConverter.GetBytes(i);
                good.Send(mark, host);
                (byte[] datagram, PeerAddress from) = host.Take();
                for (; from == stranger; (datagram, from) = host.Take())
                {
                    Assert.InRange(datagram.Length, 1, IDatagramPort.MaxDatagramBytes);
                }

                Assert.Equal((good.Address, i), (from, BitConverter.ToInt32(datagram)));
            }
        }

        byte[] longest = Pattern(IDatagramPort.MaxDatagramBytes);
        Assert.Equal(longest, host.Deliver(longest, good));
    }

    [Fact]
    public void LocalAddress_BoundToAnyAndPortZero_IsReachableOnThisMachine()
    {
        using PortEnd any = new(Open(new IPEndPoint(IPAddress.Any, 0))), other = Loopback();

        Assert.Equal(IPAddress.Loopback, any.Address.ToEndPoint().Address);
        Assert.NotEqual(0, any.Address.ToEndPoint().Port);
        other.Meet(any);
        Assert.Equal(new byte[] { 1, 2 }, other.Deliver([1, 2], any));
    }

    [Fact]
    public void LocalAddress_BoundToAnyOfIPv6_SpeaksBothFamilies()
    {
        Assert.SkipUnless(Socket.OSSupportsIPv6, "This machine has no IPv6.");
        using PortEnd a = new(Open(new IPEndPoint(IPAddress.IPv6Any, 0))), b = new(Open(new IPEndPoint(IPAddress.IPv6Any, 0)));
        Assert.Equal(IPAddress.IPv6Loopback, a.Address.ToEndPoint().Address);
        a.Meet(b);
        Assert.Equal(new byte[] { 6 }, a.Deliver([6], b));

        using PortEnd old = Loopback();
        PeerAddress asIPv4 = PeerAddress.From(new IPEndPoint(IPAddress.Loopback, a.Address.ToEndPoint().Port));
        a.Meet(old, asIPv4);
        old.Port.Send(new byte[] { 4 }, asIPv4);
        Assert.Equal(old.Address, a.Take().From);
    }

    [Fact]
    public void Constructor_PortInUse_NamesTheEndpoint()
    {
        using PortEnd first = Loopback();
        IPEndPoint taken = first.Address.ToEndPoint();

        IOException failure = Assert.Throws<IOException>(() => Open(taken));

        Assert.Contains(taken.ToString(), failure.Message, StringComparison.Ordinal);
        Assert.Equal(SocketError.AddressAlreadyInUse, Assert.IsType<SocketException>(failure.InnerException).SocketErrorCode);
    }

    [Fact]
    public void Constructor_AddressOfAnother_NamesTheEndpoint()
    {
        IPEndPoint foreign = new(IPAddress.Parse("192.0.2.1"), 0); // for documents only: nobody has it

        IOException failure = Assert.Throws<IOException>(() => Open(foreign));

        Assert.Contains(foreign.ToString(), failure.Message, StringComparison.Ordinal);
        Assert.IsType<SocketException>(failure.InnerException);
    }

    [Fact]
    public void Constructor_Null_IsRefused() => Assert.Throws<ArgumentNullException>("bind", () => Open(null!));

    [Fact]
    public async Task Dispose_WhileItWaits_EndsItsThreadAndFreesThePort()
    {
        IDatagramPort port = Open(new IPEndPoint(IPAddress.Loopback, 0));
        IPEndPoint endPoint = port.LocalAddress.ToEndPoint();
        CancellationToken cancellation = TestContext.Current.CancellationToken;
        await Task.Run(port.Dispose, cancellation).WaitAsync(TimeSpan.FromMinutes(1), cancellation); // it may not hang
        port.Dispose();
        Assert.Throws<ObjectDisposedException>(() => port.Send(new byte[1], PeerAddress.From(endPoint)));
        Assert.False(port.TryReceive(new byte[IDatagramPort.MaxDatagramBytes], out _, out _));
        using IDatagramPort again = Open(endPoint);
        Assert.Equal(endPoint, again.LocalAddress.ToEndPoint());
    }

    [Fact]
    public void Dispose_WithSomethingWaiting_LeavesItToBeTaken()
    {
        using PortEnd a = Loopback(), b = Loopback();
        a.Meet(b);
        using ManualResetEventSlim arrived = new();
        b.Port.Arrived += arrived.Set;
        a.Send([9], b);
        Assert.True(arrived.Wait(PortEnd.Deadline, TestContext.Current.CancellationToken));

        b.Port.Dispose();

        Assert.True(b.TryTake(out byte[] datagram, out PeerAddress from));
        Assert.Equal((9, a.Address), (datagram[0], from));
    }

    [Fact]
    public void Dispose_ByAHandlerOfArrived_DoesNotHang()
    {
        using PortEnd a = Loopback(), b = Loopback();
        a.Meet(b);
        using ManualResetEventSlim closed = new();
        b.Port.Arrived += () =>
        {
            b.Port.Dispose();
            closed.Set();
        };

        a.Send([1], b);

        Assert.True(closed.Wait(PortEnd.Deadline, TestContext.Current.CancellationToken));
        Assert.Throws<ObjectDisposedException>(() => b.Send([1], a));
    }

    /// <summary>How many datagrams can wait in a port.</summary>
    protected abstract int RingSlots { get; }

    /// <summary>A port of the carrier.</summary>
    protected abstract IDatagramPort Open(IPEndPoint bind);

    /// <summary>How many datagrams came in by a port and were thrown away.</summary>
    protected abstract long Dropped(IDatagramPort port);

    private static byte[] Pattern(int size) => Enumerable.Range(0, size).Select(i => (byte)((i * 31) + size)).ToArray();

    private static string Refused(Action call) => Assert.Throws<ArgumentException>(call).Message;

    private PortEnd Loopback() => new(Open(new IPEndPoint(IPAddress.Loopback, 0)));
}
