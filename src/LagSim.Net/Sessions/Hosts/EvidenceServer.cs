using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Tells a joiner whose committed state is another the host's events of the time in which that came about.</summary>
internal sealed class EvidenceServer(
    JoinerRoster roster, EventJournal journal, SharedWorld world, Watermark watermark, DatagramSender sender,
    SessionCounters counters, IClock clock)
{
    /// <summary>Raised for each joiner, once, that says its committed state at that time is not this host's.</summary>
    internal event Action<byte, SimTime>? Diverged;

    internal void OnDoubt(in DoubtDatagram doubt, PeerAddress from)
    {
        Joiner? joiner = roster.Of(doubt.SessionId);
        SimTime now = clock.Now;
        bool isItsTurn = joiner is not null && joiner.Link.Other == from && joiner.Peer == doubt.Peer && doubt.Number > joiner.Doubted;
        if (!isItsTurn || world.Live is null || doubt.UpTo >= watermark.Now || !joiner!.Doubts.TrySpend(now))
        {
            counters.DatagramsIgnored++; // what is not committed may still change
            return;
        }

        bool isFirst = joiner.Doubted == 0;
        joiner.Doubted = doubt.Number;
        joiner.Link.CountReceived(WireFormat.DoubtBytes);
        Answer(joiner, doubt);
        if (isFirst)
        {
            Diverged?.Invoke(joiner.Peer, doubt.UpTo);
        }
    }

    private void Answer(Joiner joiner, in DoubtDatagram doubt)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        bool isWhole = journal.Recent.IsWholeAfter(doubt.After);
        List<LogEntry> events = journal.Recent.Between(doubt.After, doubt.UpTo);
        if (!isWhole || events.Count == 0)
        {
            sender.Send(bytes.Slice(0, new EvidenceDatagram(doubt.SessionId, isWhole).Encode(bytes)), joiner.Link);
            return;
        }

        for (long n = doubt.First; n < events.Count && n < (long)doubt.First + DoubtDatagram.MaxEvents; n++)
        {
            LogEntry entry = events[(int)n];
            EvidenceDatagram evidence = new(doubt.SessionId, (uint)events.Count, (uint)n, entry.Index, entry.Event);
            sender.Send(bytes.Slice(0, evidence.Encode(bytes)), joiner.Link);
        }
    }
}
