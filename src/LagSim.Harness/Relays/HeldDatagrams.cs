using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Relays;

/// <summary>
/// A queue of datagrams that were taken from a port and are not yet due. Each sender has its own link. Not thread-safe.
/// </summary>
/// <remarks>Holds at most <see cref="MaxHeld"/> datagrams; further ones are lost, as in any full queue.</remarks>
internal sealed class HeldDatagrams
{
    /// <summary>The most datagrams held at a time: some 80 MB at their largest size.</summary>
    internal const int MaxHeld = 1 << 16;

    private readonly Func<PeerAddress, LinkModel?> linkFrom;
    private readonly Dictionary<PeerAddress, LinkModel> links = [];
    private readonly PriorityQueue<(byte[] Datagram, PeerAddress From), (SimTime Due, long Sequence)> held = new();
    private readonly List<LinkModel> deciding = []; // those that do not decide at once
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private long sequence;
    private int undecided;

    /// <summary>Creates an empty queue.</summary>
    /// <param name="linkFrom">Called once for each new sender to get its link. If it returns null, the datagram is refused, and the next
    /// one asks again.</param>
    internal HeldDatagrams(Func<PeerAddress, LinkModel?> linkFrom) => this.linkFrom = linkFrom;

    /// <summary>The number of datagrams lost on the link.</summary>
    internal long Lost { get; private set; }

    /// <summary>The number of datagrams from senders without a link.</summary>
    internal long Refused { get; private set; }

    /// <summary>The time at which the next datagram is due or a queue decides on one; null when none is held.</summary>
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

    /// <summary>
    /// Returns a link factory that gives each sender the same leg with its own seed, in the order of their first datagrams.
    /// </summary>
    internal static Func<PeerAddress, LinkModel> SameLegs(LinkLeg leg, ulong seed)
    {
        ArgumentNullException.ThrowIfNull(leg);
        SeededRandom random = new(seed);
        ulong senders = 0;
        return _ => new LinkModel(leg, random.Fork(senders++));
    }

    /// <summary>Takes every datagram from the port, as sent at <paramref name="now"/>. Returns true if there was any.</summary>
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

    /// <summary>Returns the earliest datagram due by <paramref name="now"/>; at one tick the one that arrived first.</summary>
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
