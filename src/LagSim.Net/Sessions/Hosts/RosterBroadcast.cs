using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Keeps the roster of the session, and sends each client what has changed of it until the client has it.</summary>
/// <remarks>
/// Each change has a revision. A client is sent the changes after the revision that it has, the earliest first, as many as one datagram
/// holds, so whatever is lost is in the next one.
/// </remarks>
internal sealed class RosterBroadcast
{
    private readonly RosterEntry[] entries = new RosterEntry[SessionOptions.MaxNumber + 1];
    private readonly RosterEntry[] found = new RosterEntry[SessionOptions.MaxNumber + 1];
    private readonly uint[] revisions = new uint[SessionOptions.MaxNumber + 1];
    private readonly RosterDatagram page = new();
    private readonly byte[] buffer = new byte[WireFormat.MaxPlainBytes];
    private readonly ClientRoster clients;
    private readonly PlayerPlaces places;
    private readonly ClientTimeouts timeouts;
    private readonly SessionParts parts;
    private uint newest;

    internal RosterBroadcast(ClientRoster clients, PlayerPlaces places, ClientTimeouts timeouts, SessionParts parts)
    {
        this.clients = clients;
        this.places = places;
        this.timeouts = timeouts;
        this.parts = parts;
        for (int number = 0; number < entries.Length; number++)
        {
            entries[number] = new RosterEntry((byte)number);
        }
    }

    /// <summary>When something is to be sent again, by the local clock.</summary>
    internal SimTime NextDue()
    {
        SimTime due = SimTime.MaxValue;
        foreach (Client client in clients.All)
        {
            due = client.Peer > 0 && client.HasWritten && client.Roster.Acknowledged < newest ? SimTime.Min(due, client.Roster.Due) : due;
        }

        return due;
    }

    /// <summary>Brings the roster up to date with the clients, and sends what is due.</summary>
    internal void Tend(SimTime now)
    {
        Refresh();
        foreach (Client client in clients.All)
        {
            if (client.Peer > 0 && client.HasWritten && client.Roster.IsDue(newest, now))
            {
                Send(client, now);
            }
        }
    }

    /// <summary>Brings the roster up to date with the clients.</summary>
    internal void Refresh()
    {
        SimTime now = parts.Clock.Now;
        for (int number = 0; number < found.Length; number++)
        {
            found[number] = new RosterEntry((byte)number);
        }

        found[0] = new RosterEntry(0, (byte)parts.Options.Role, 0, SimTime.MinValue, parts.Options.Name);
        foreach (Client client in clients.All)
        {
            if (client.Peer > 0)
            {
                found[client.Peer] = EntryOf(client, now);
            }
        }

        bool any = false;
        for (int number = 0; number < found.Length; number++)
        {
            if (!found[number].IsSame(entries[number]))
            {
                entries[number] = found[number];
                revisions[number] = ++newest;
                any = true;
            }
        }

        if (any)
        {
            Publish();
        }
    }

    /// <summary>Takes a client's acknowledgement.</summary>
    internal void OnReceived(in RosterReceivedDatagram received, PeerAddress from)
    {
        if (clients.Of(received.SessionId) is Client client && client.Link.Other == from
            && (client.Peer == received.Peer || received.Peer == 0) && client.Roster.Acknowledge(received.Revision))
        {
            client.Link.CountReceived(WireFormat.RosterReceivedBytes);
        }
        else
        {
            parts.Counters.DatagramsIgnored++;
        }
    }

    private RosterEntry EntryOf(Client client, SimTime now)
    {
        PlayerPlaces.Place place = places[client.Peer];
        SimTime silent = timeouts.IsSilent(client, now) ? parts.SharedTime.Now - (now - client.Link.Heard) : SimTime.MinValue;
        RosterEntry before = entries[client.Peer];
        bool isStill = silent != SimTime.MinValue && before.Visit == place.Visit && before.Role != RosterEntry.NoRole
            && before.SilentSince != SimTime.MinValue;
        return new RosterEntry(client.Peer, client.Claim.Role, place.Visit, isStill ? before.SilentSince : silent, clients.NameOf(client));
    }

    private void Publish()
    {
        List<RosterMember> members = new();
        foreach (ref readonly RosterEntry entry in entries.AsSpan())
        {
            if (entry.Role != RosterEntry.NoRole)
            {
                members.Add(RosterMembers.Of(entry));
            }
        }

        parts.Peers.Replace(members);
    }

    private void Send(Client client, SimTime now)
    {
        UpdateLink link = client.Link;
        page.Clear();
        page.SessionId = link.SessionId;
        page.After = page.UpTo = client.Roster.Acknowledged;
        page.Newest = newest;
        while (Next(page.UpTo) is int number && page.TryAdd(entries[number], link.Path.PlainBytes))
        {
            page.UpTo = revisions[number];
        }

        SimDuration trip = link.Trips.IsMeasured ? link.Trips.Mean + (link.Trips.Mean / 4) : SimDuration.Zero;
        SimDuration pause = trip > parts.Options.ResendInterval ? trip : parts.Options.ResendInterval;
        client.Roster.NoteSent(page.UpTo, newest, now, pause);
        parts.Sender.Send(buffer.AsSpan(0, page.Encode(buffer)), link);
    }

    /// <summary>The number whose change is the first after a revision; null for none.</summary>
    private int? Next(uint after)
    {
        int? next = null;
        for (int number = 0; number < revisions.Length; number++)
        {
            if (revisions[number] > after && (next is null || revisions[number] < revisions[next.Value]))
            {
                next = number;
            }
        }

        return next;
    }
}
