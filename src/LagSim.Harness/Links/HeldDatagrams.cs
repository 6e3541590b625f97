using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Harness.Links;

/// <summary>Datagrams on the last part of their way: taken from a port, not yet due. Each sender has its own link. Not thread-safe.</summary>
/// <remarks>At most <see cref="MaxHeld"/> are held; what comes beyond that is lost, as in any queue that is full.</remarks>
internal sealed class HeldDatagrams
{
    /// <summary>The most that are held at a time: some 80 MB if all are as long as they may be.</summary>
    internal const int MaxHeld = 1 << 16;

    private readonly Func<PeerAddress, LinkModel?> linkFrom;
    private readonly Dictionary<PeerAddress, LinkModel> links = [];
    private readonly PriorityQueue<(byte[] Datagram, PeerAddress From), (SimTime Due, long Sequence)> held = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private long sequence;

    /// <summary>Nothing held yet.</summary>
    /// <param name="linkFrom">Called once for each sender; null refuses a datagram, and the sender is asked about again.</param>
    internal HeldDatagrams(Func<PeerAddress, LinkModel?> linkFrom) => this.linkFrom = linkFrom;

    /// <summary>How many were lost on the way.</summary>
    internal long Lost { get; private set; }

    /// <summary>How many came from a sender that has no link.</summary>
    internal long Refused { get; private set; }

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
            if (LinkFrom(from) is not LinkModel link)
            {
                Refused++;
                continue;
            }

            LinkDeliveries deliveries = link.Send(now);
            if (deliveries.Count == 0 || held.Count + deliveries.Count > MaxHeld)
            {
                Lost++;
                continue;
            }

            byte[] datagram = buffer.AsSpan(0, length).ToArray();
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

    private LinkModel? LinkFrom(PeerAddress sender)
    {
        if (!links.TryGetValue(sender, out LinkModel? link))
        {
            link = linkFrom(sender);
            if (link is not null)
            {
                links[sender] = link;
            }
        }

        return link;
    }
}
