using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;

namespace LagSim.Tests.Fuzz;

/// <summary>A port that keeps two kilobytes of each datagram taken from it: as a session would that forgets to forget.</summary>
internal sealed class LeakingPort(IDatagramPort inner) : IDatagramPort
{
    private readonly List<byte[]> kept = [];

    public event Action? Arrived
    {
        add => inner.Arrived += value;
        remove => inner.Arrived -= value;
    }

    public PeerAddress LocalAddress => inner.LocalAddress;

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to) => inner.Send(datagram, to);

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        bool has = inner.TryReceive(buffer, out length, out from);
        if (has)
        {
            kept.Add(new byte[2_048]);
        }

        return has;
    }

    public void Dispose() => inner.Dispose();
}
