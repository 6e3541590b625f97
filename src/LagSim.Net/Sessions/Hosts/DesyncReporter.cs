using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Sends a client whose committed state differs the host's events of the time in which the difference arose.</summary>
internal sealed class DesyncReporter(
    ClientRoster roster, EventJournal journal, SharedWorld world, Watermark watermark, DatagramSender sender,
    SessionCounters counters, IClock clock)
{
    /// <summary>Raised, once for each client, when it reports that its committed state at that time differs from this host's.</summary>
    internal event Action<byte, SimTime>? Diverged;

    internal void OnDesyncQuery(in DesyncQueryDatagram query, PeerAddress from)
    {
        Client? client = roster.Of(query.SessionId);
        SimTime now = clock.Now;
        bool isItsTurn = client is not null && client.Link.Other == from && client.Peer == query.Peer
            && query.Number > client.DesyncQueries.Last;
        if (!isItsTurn || world.Live is null || query.UpTo >= watermark.Now || !client!.DesyncQueries.TrySpend(now))
        {
            counters.DatagramsIgnored++; // uncommitted history may still change
            return;
        }

        bool isFirst = client.DesyncQueries.Last == 0;
        client.DesyncQueries.Last = query.Number;
        client.Link.CountReceived(WireFormat.DesyncQueryBytes);
        Answer(client, query);
        if (isFirst)
        {
            Diverged?.Invoke(client.Peer, query.UpTo);
        }
    }

    private void Answer(Client client, in DesyncQueryDatagram query)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxPlainBytes];
        bool isWhole = journal.Recent.IsWholeAfter(query.After);
        List<LogEntry> events = journal.Recent.Between(query.After, query.UpTo);
        if (!isWhole || events.Count == 0)
        {
            sender.Send(bytes.Slice(0, new DesyncReportDatagram(query.SessionId, isWhole).Encode(bytes)), client.Link);
            return;
        }

        for (long n = query.First; n < events.Count && n < (long)query.First + DesyncQueryDatagram.MaxEvents; n++)
        {
            LogEntry entry = events[(int)n];
            DesyncReportDatagram report = new(query.SessionId, (uint)events.Count, (uint)n, entry.Index, entry.Event);
            sender.Send(bytes.Slice(0, report.Encode(bytes)), client.Link);
        }
    }
}
