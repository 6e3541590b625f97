using System;
using System.Collections.Generic;
using System.Net;
using LagSim.Net.Carriers;

namespace LagSim.Tests.Sessions;

/// <summary>
/// A host's port in a virtual network, seen from behind the others' NATs: each node has an IP address and a port, and may get others at any
/// time.
/// </summary>
/// <remarks>What the host sends to an address that no node has any more is lost, as behind a real NAT.</remarks>
internal sealed class NatPort(IDatagramPort inner) : IDatagramPort
{
    private readonly Dictionary<PeerAddress, PeerAddress> outside = [];
    private readonly Dictionary<PeerAddress, PeerAddress> inside = [];

    public event Action? Arrived
    {
        add => inner.Arrived += value;
        remove => inner.Arrived -= value;
    }

    public PeerAddress LocalAddress => inner.LocalAddress;

    /// <summary>The address of a port of a machine, 1 and up.</summary>
    internal static PeerAddress Address(int machine, int port) =>
        PeerAddress.From(new IPEndPoint(new IPAddress([10, (byte)(machine >> 16), (byte)(machine >> 8), (byte)machine]), port));

    /// <summary>Has a node be seen at that port of that machine from now on.</summary>
    internal void Place(int node, int machine, int port)
    {
        PeerAddress own = PeerAddress.Virtual(node), seen = Address(machine, port);
        if (outside.TryGetValue(own, out PeerAddress before))
        {
            inside.Remove(before);
        }

        outside[own] = seen;
        inside[seen] = own;
    }

    public void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        if (inside.TryGetValue(to, out PeerAddress node))
        {
            inner.Send(datagram, node);
        }
        else if (to.ToString().StartsWith("virtual", StringComparison.Ordinal))
        {
            inner.Send(datagram, to);
        }
    }

    public bool TryReceive(Span<byte> buffer, out int length, out PeerAddress from)
    {
        bool came = inner.TryReceive(buffer, out length, out PeerAddress node);
        from = came && outside.TryGetValue(node, out PeerAddress seen) ? seen : node;
        return came;
    }

    public void Dispose() => inner.Dispose();
}
