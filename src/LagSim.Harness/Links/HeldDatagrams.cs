using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Harness.Links;

/// <summary>Datagrams on the last part of their way: taken from a port, not yet due. Each sender has its own link. Not thread-safe.</summary>
internal sealed class HeldDatagrams
{
    private readonly Func<PeerAddress, LinkModel> linkFrom;
    private readonly Dictionary<PeerAddress, LinkModel> links = [];
    private readonly PriorityQueue<(byte[] Datagram, PeerAddress From), (SimTime Due, long Sequence)> held = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private long sequence;

    internal HeldDatagrams(Func<PeerAddress, LinkModel> linkFrom) => this.linkFrom = linkFrom;

    internal SimTime? NextDue => held.TryPeek(out _, out (SimTime Due, long Sequence) first) ? first.Due : null;

    /// <summary>A link maker that gives each sender the same leg and its own luck, in the order in which they are first heard of.</summary>
    internal static Func<PeerAddress, LinkModel> SameLegs(LinkLeg leg, ulong seed)
    {
        ArgumentNullException.ThrowIfNull(leg);
        SeededRandom random = new(seed);
        ulong senders = 0;
        return _ => new LinkModel(leg, random.Fork(senders++));
    }

    /// <summary>Takes all that the port has, as sent at <paramref name="now"/>; true if it had any.</summary>
    internal bool TakeFrom(IDatagramPort port, SimTime now)
    {
        bool any = false;
        while (port.TryReceive(buffer, out int length, out PeerAddress from))
        {
            any = true;
            if (!links.TryGetValue(from, out LinkModel? link))
            {
                links[from] = link = linkFrom(from);
            }

            LinkDeliveries deliveries = link.Send(now);
            byte[] datagram = deliveries.Count == 0 ? [] : buffer.AsSpan(0, length).ToArray();
            for (int i = 0; i < deliveries.Count; i++)
            {
                held.Enqueue((datagram, from), (deliveries[i], sequence++));
            }
        }

        return any;
    }

    /// <summary>The earliest datagram that is due by <paramref name="now"/>; of those due at one tick the one that came first.</summary>
    internal bool TryDequeueDue(SimTime now, out (byte[] Datagram, PeerAddress From) datagram)
    {
        if (held.TryPeek(out datagram, out (SimTime Due, long Sequence) first) && first.Due <= now)
        {
            held.Dequeue();
            return true;
        }

        datagram = default;
        return false;
    }
}
