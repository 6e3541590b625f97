using System;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using LagSim.Net.Carriers;
using Xunit;

namespace LagSim.Tests.Carriers;

/// <summary>A port as a test uses it: woken by <see cref="IDatagramPort.Arrived"/> alone, and given up after a deadline.</summary>
internal sealed class PortEnd : IDisposable
{
    internal static readonly TimeSpan Deadline = TimeSpan.FromSeconds(20);

    private static readonly byte[] Greeting = [0xA5, 0x5A, 0xA5, 0x5A];
    private static readonly byte[] Fence = [0x5A, 0xA5, 0x5A, 0xA5];
    private const int GreetAgainMilliseconds = 20; // as a session does with its join

    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly AutoResetEvent arrived = new(false);

    internal PortEnd(IDatagramPort port)
    {
        Port = port;
        port.Arrived += Wake;
    }

    internal IDatagramPort Port { get; }

    internal PeerAddress Address => Port.LocalAddress;

    public void Dispose()
    {
        Port.Dispose();
        Port.Arrived -= Wake;
        arrived.Dispose();
    }

    internal void Send(byte[] datagram, PortEnd to) => Port.Send(datagram, to.Address);

    internal bool TryTake(out byte[] datagram, out PeerAddress from)
    {
        bool any = Port.TryReceive(buffer, out int length, out from);
        datagram = buffer[..(any ? length : 0)];
        return any;
    }

    /// <summary>The next datagram, waited for.</summary>
    internal (byte[] Datagram, PeerAddress From) Take()
    {
        long began = Stopwatch.GetTimestamp();
        byte[] datagram;
        PeerAddress from;
        while (!TryTake(out datagram, out from))
        {
            TimeSpan left = Deadline - Stopwatch.GetElapsedTime(began);
            Assert.True(left > TimeSpan.Zero && arrived.WaitOne(left), "The datagram did not arrive.");
        }

        return (datagram, from);
    }

    /// <summary>Greets another until it hears: a carrier may need a connection first, and lose what is sent before. Nothing is on its way afterwards.</summary>
    internal void Meet(PortEnd other) => Meet(other, Address);

    /// <summary>The same where the other knows this one by another address.</summary>
    internal void Meet(PortEnd other, PeerAddress known)
    {
        long began = Stopwatch.GetTimestamp();
        byte[] datagram;
        PeerAddress from;
        while (!(other.TryTake(out datagram, out from) && from == known && datagram.SequenceEqual(Greeting)))
        {
            Assert.True(Stopwatch.GetElapsedTime(began) < Deadline, "The other was not reached.");
            Send(Greeting, other);
            other.arrived.WaitOne(GreetAgainMilliseconds);
        }

        Send(Fence, other); // loopback keeps order: what was sent before is through
        while (!other.Take().Datagram.SequenceEqual(Fence))
        {
        }
    }

    /// <summary>Sends one datagram and gives back how it arrived.</summary>
    internal byte[] Deliver(byte[] datagram, PortEnd to)
    {
        Send(datagram, to);
        (byte[] taken, PeerAddress from) = to.Take();
        Assert.Equal(Address, from);
        return taken;
    }

    private void Wake()
    {
        try
        {
            arrived.Set();
        }
        catch (ObjectDisposedException)
        {
            // The port was on its way out.
        }
    }
}
