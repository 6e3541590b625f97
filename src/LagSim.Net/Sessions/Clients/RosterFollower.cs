using System;
using System.Collections.Generic;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Follows the host's roster: takes its changes in order, acknowledges them, and publishes them once it has all.</summary>
internal sealed class RosterFollower(
    HostConnection connection, PeerRoster peers, SharedClock sharedTime, DatagramSender sender, SessionCounters counters,
    SimDuration silence)
{
    private readonly RosterEntry[] entries = new RosterEntry[byte.MaxValue + 1];
    private readonly RosterDatagram page = new();
    private UpdateLink? of; // the link that what follows came over
    private uint revision;
    private bool isWhole;
    private SimTime hostSilentSince = SimTime.MinValue;

    internal void OnRoster(ReadOnlySpan<byte> datagram)
    {
        if (!counters.IsWellFormed(page.TryDecode(datagram, out _)))
        {
            return;
        }

        if (connection.Link is not UpdateLink link || page.SessionId != link.SessionId)
        {
            counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(datagram.Length);
        if (link != of)
        {
            (of, revision, isWhole) = (link, 0, false);
            Array.Clear(entries, 0, entries.Length);
        }

        if (page.After > revision)
        {
            counters.DatagramsIgnored++; // what comes before it is not here
            return;
        }

        if (page.UpTo > revision)
        {
            Take();
        }

        Span<byte> bytes = stackalloc byte[WireFormat.RosterReceivedBytes];
        sender.Send(bytes.Slice(0, new RosterReceivedDatagram(link.SessionId, link.Self, revision).Encode(bytes)), link);
        if (isWhole)
        {
            Publish();
        }
    }

    /// <summary>Notices a host that has fallen silent, or is heard again.</summary>
    internal void Tend(SimTime now)
    {
        if (!isWhole || connection.Link != of || of is null)
        {
            return;
        }

        bool isSilent = now - of.Heard > silence;
        if (isSilent != (hostSilentSince != SimTime.MinValue))
        {
            hostSilentSince = isSilent ? sharedTime.Now - (now - of.Heard) : SimTime.MinValue;
            Publish();
        }
    }

    private void Take()
    {
        foreach (ref readonly RosterEntry entry in page.Entries)
        {
            entries[entry.Number] = entry;
        }

        revision = page.UpTo;
        isWhole |= page.UpTo == page.Newest;
    }

    private void Publish()
    {
        List<RosterMember> members = new();
        foreach (ref readonly RosterEntry entry in entries.AsSpan())
        {
            if (entry.Role != RosterEntry.NoRole)
            {
                members.Add(RosterMembers.Of(
                    entry.Number == 0 ? new RosterEntry(0, entry.Role, entry.Visit, hostSilentSince, entry.Name) : entry));
            }
        }

        peers.Replace(members);
    }
}
