using System;
using System.Collections.Generic;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>All clients that a host has a link to: those that are in, and those still joining.</summary>
internal sealed class ClientRoster(PlayerPlaces places, DatagramSender sender, IClock clock)
{
    private readonly List<Client> clients = new();

    /// <summary>Raised, once, for each client that had a number and is gone, with the total traffic of its link.</summary>
    internal event Action<LinkTraffic>? Gone;

    /// <summary>All clients, in the order in which they came.</summary>
    internal List<Client> All => clients;

    /// <summary>The number of clients that are in.</summary>
    internal int SeatedCount => CountUpTo(SessionOptions.MaxNumber);

    /// <summary>The number of those of them that play.</summary>
    internal int PlayerCount => CountUpTo(SessionOptions.MaxClients);

    /// <summary>
    /// The time before which none of those who play will stamp an event any more; the latest instant if nobody plays besides the host.
    /// </summary>
    internal SimTime Promised()
    {
        SimTime promised = SimTime.MaxValue;
        foreach (Client client in clients)
        {
            promised = Plays(client) ? SimTime.Min(promised, client.Stamps.Promised) : promised;
        }

        return promised;
    }

    /// <summary>
    /// The time before which none of those who play is expected to stamp an event that is still on its way: what those who act have promised;
    /// of the others a round trip ago, so that the first that one of them does on a slow link is not too late.
    /// </summary>
    /// <param name="now">The instant that a round trip is counted from.</param>
    /// <param name="acting">For how long after its newest event one acts.</param>
    internal SimTime Expected(SimTime now, SimDuration acting)
    {
        SimTime expected = SimTime.MaxValue;
        foreach (Client client in clients)
        {
            expected = !Plays(client) ? expected
                : SimTime.Min(expected, client.Stamps.Acted >= now - acting ? client.Stamps.Promised : now - client.Link.Trips.Least);
        }

        return expected;
    }

    /// <summary>Returns the client with that link. A loop, since a delegate would be allocated for every datagram.</summary>
    internal Client? Of(ulong session)
    {
        foreach (Client client in clients)
        {
            if (client.Link.SessionId == session)
            {
                return client;
            }
        }

        return null;
    }

    /// <summary>Returns the client with that number.</summary>
    internal Client? Seated(byte player) => clients.Find(j => j.Peer == player);

    /// <summary>What a backend says of the player with that number; null without a connect token.</summary>
    internal PlayerAdmission? AdmissionOf(byte player) => Seated(player) is null ? null : places[player].Admission;

    private static bool Plays(Client client) => PlayerPlaces.IsFor(client.Peer, isSpectator: false);

    private int CountUpTo(byte number)
    {
        int count = 0;
        foreach (Client client in clients)
        {
            count += client.Peer > 0 && client.Peer <= number ? 1 : 0;
        }

        return count;
    }

    /// <summary>Forgets a client, and wipes its keys.</summary>
    /// <returns>False if it was gone already.</returns>
    internal bool Drop(Client client)
    {
        client.Link.Seal?.Dispose();
        return clients.Remove(client);
    }

    /// <summary>Forgets all matching clients that have no number.</summary>
    internal void DropAll(Predicate<Client> isIt)
    {
        foreach (Client client in clients.FindAll(isIt))
        {
            Drop(client);
        }
    }

    /// <summary>Removes a client.</summary>
    /// <param name="client">The client.</param>
    /// <param name="why">The reason. Its number is reserved for it unless it left for good or was kicked.</param>
    /// <returns>False if it was gone already.</returns>
    internal bool Disconnect(Client client, LeaveReason why)
    {
        if (!Drop(client))
        {
            return false;
        }

        if (client.Peer > 0)
        {
            places[client.Peer].Leave(why is not (LeaveReason.Left or LeaveReason.Kicked), client.Link.SessionId, why, clock.Now);
            Gone?.Invoke(client.Link.Traffic);
        }

        return true;
    }

    /// <summary>Says goodbye to a client, and removes it.</summary>
    internal void Dismiss(Client client, LeaveReason why)
    {
        sender.SayGoodbye(client.Link, 0, why);
        Disconnect(client, why);
    }

    /// <summary>Sends away all matching clients; returns how many.</summary>
    /// <param name="isIt">Which.</param>
    /// <param name="why">What they are told, as a sentence; empty for nothing but that they are sent away.</param>
    internal int Kick(Predicate<Client> isIt, string why = "")
    {
        List<Client> all = clients.FindAll(isIt);
        foreach (Client client in all)
        {
            for (int n = 0; n < DatagramSender.Goodbyes && clients.Contains(client); n++) // a handler may have sent it away already
            {
                sender.SayGoodbye(client.Link, 0, LeaveReason.Kicked, why);
            }

            Disconnect(client, LeaveReason.Kicked);
        }

        return all.Count;
    }

    /// <summary>
    /// Sends a player away that keeps its pass, and what its token says of it: while it is shut out, the pass tells who it is, and afterwards
    /// it may do no more than before.
    /// </summary>
    internal void Expel(Client client, string why)
    {
        PlayerPlaces.Place place = places[client.Peer];
        (Token128? pass, PlayerAdmission? admission) = (place.Pass, place.Admission);
        if (Kick(j => j == client, why) > 0 && !place.IsTaken)
        {
            place.Keep(pass, admission);
        }
    }

    /// <summary>What a client that is in is called: by its token, or else by itself.</summary>
    internal string NameOf(Client client) =>
        places[client.Peer].Admission is PlayerAdmission { Name.Length: > 0 } player ? player.Name : client.Claim.Name;

    /// <summary>By what the host knows a client that is in again.</summary>
    internal KnownPlayer KnownOf(Client client) =>
        new(places[client.Peer].Admission, client.Claim.Identity.Keyed, places[client.Peer]);

    /// <summary>Wipes the keys of all links. Nothing can be sent over them any more.</summary>
    internal void WipeKeys() => clients.ForEach(static client => client.Link.Seal?.Dispose());

    /// <summary>Notifies all clients that the session is over.</summary>
    /// <param name="failure">What failed, as a sentence; null if the session ends properly.</param>
    internal void Farewell(string? failure)
    {
        for (int n = 0; n < DatagramSender.Goodbyes; n++)
        {
            foreach (Client client in clients)
            {
                sender.SayGoodbye(client.Link, 0, failure is null ? LeaveReason.HostEnded : LeaveReason.HostFailed, failure ?? "");
            }
        }
    }
}
