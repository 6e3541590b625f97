using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// Datagrams on the last part of their way: taken from a port, not yet due. Each sender has its own link. Not thread-safe.
/// </summary>
/// <remarks>At most <see cref="MaxHeld"/> are held; what comes beyond that is lost, as in any queue that is full.</remarks>
internal sealed class HeldDatagrams
{
    /// <summary>The most that are held at a time: some 80 MB if all are as long as they may be.</summary>
    internal const int MaxHeld = 1 << 16;

    private readonly Func<PeerAddress, LinkModel?> linkFrom;
    private readonly Dictionary<PeerAddress, LinkModel> links = [];
    private readonly PriorityQueue<(byte[] Datagram, PeerAddress From), (SimTime Due, long Sequence)> held = new();
    private readonly List<LinkModel> deciding = []; // those that do not decide at once
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private long sequence;
    private int undecided;

    /// <summary>Nothing held yet.</summary>
    /// <param name="linkFrom">Called once for each sender; null refuses a datagram, and the sender is asked about again.</param>
    internal HeldDatagrams(Func<PeerAddress, LinkModel?> linkFrom) => this.linkFrom = linkFrom;

    /// <summary>How many were lost on the way.</summary>
    internal long Lost { get; private set; }

    /// <summary>How many came from a sender that has no link.</summary>
    internal long Refused { get; private set; }

    /// <summary>When the next is due, or a queue decides on one; null when none is held.</summary>
    internal SimTime? NextDue
    {
        get
        {
            SimTime? next = held.TryPeek(out _, out (SimTime Due, long Sequence) first) ? first.Due : null;
            foreach (LinkModel link in deciding)
            {
                next = link.Queue!.NextDecision is SimTime decision && !(next <= decision) ? decision : next;
            }

            return next;
        }
    }

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

            if (link.DecidesAtOnce)
            {
                Hold(link.Send(now, length), buffer.AsSpan(0, length), from);
            }
            else if (held.Count + undecided >= MaxHeld)
            {
                Lost++;
            }
            else
            {
                byte[] datagram = buffer.AsSpan(0, length).ToArray();
                undecided++;
                link.Send(now, length, deliveries =>
                {
                    undecided--;
                    Hold(deliveries, datagram, from);
                });
            }
        }

        return any;
    }

    /// <summary>The earliest datagram that is due by <paramref name="now"/>; of those due at one tick the one that came first.</summary>
    internal bool TryDequeueDue(SimTime now, out (byte[] Datagram, PeerAddress From) datagram)
    {
        foreach (LinkModel link in deciding)
        {
            link.Queue!.DecideUntil(now);
        }

        if (held.TryPeek(out datagram, out (SimTime Due, long Sequence) first) && first.Due <= now)
        {
            held.Dequeue();
            return true;
        }

        datagram = default;
        return false;
    }

    private void Hold(in LinkDeliveries deliveries, ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (deliveries.Count == 0 || held.Count + deliveries.Count > MaxHeld)
        {
            Lost++;
            return;
        }

        byte[] copy = datagram.ToArray();
        for (int i = 0; i < deliveries.Count; i++)
        {
            held.Enqueue((copy, from), (deliveries[i], sequence++));
        }
    }

    private LinkModel? LinkFrom(PeerAddress sender)
    {
        if (!links.TryGetValue(sender, out LinkModel? link))
        {
            link = linkFrom(sender);
            if (link is not null)
            {
                links[sender] = link;
                if (!link.DecidesAtOnce)
                {
                    deciding.Add(link);
                }
            }
        }

        return link;
    }
}
