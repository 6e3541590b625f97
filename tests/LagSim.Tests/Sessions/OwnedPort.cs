using System;
using System.Net;
using LagSim.Net.Carriers;

namespace LagSim.Tests.Sessions;

/// <summary>A socket that tells whether it was disposed of.</summary>
internal sealed class OwnedPort : IDatagramPort
{
    private readonly UdpPort inner = new(new IPEndPoint(IPAddress.Loopback, 0));

    public event Action? Arrived
    {
        add => inner.Arrived += value;
        remove
        {
            inner.Arrived -= value;
            if (BreaksAtTheEnd)
            {
                throw new FormatException("a carrier that breaks at its end");
            }
        }
    }

    /// <summary>Whether every read throws.</summary>
    public bool Breaks { get; set; }

    /// <summary>Whether its end throws.</summary>
    public bool BreaksAtTheEnd { get; init; }

    public int Disposals { get; private set; }

    public bool IsDisposed => Disposals > 0;

    public PeerAddress LocalAddress => inner.LocalAddress;

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => inner.Send(datagram, to);

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from) =>
        Breaks ? throw new FormatException("a carrier that breaks") : inner.TryReceive(buffer, out length, out from);

    public void Dispose()
    {
        Disposals++;
        inner.Dispose();
        if (BreaksAtTheEnd)
        {
            throw new FormatException("a carrier that breaks at its end");
        }
    }
}
