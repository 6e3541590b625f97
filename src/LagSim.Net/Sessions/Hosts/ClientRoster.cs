using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Everyone to whom a host has a link: those that are in, and those that are still coming in.</summary>
internal sealed class ClientRoster(PlayerPlaces places, DatagramSender sender, IClock clock)
{
    private readonly List<Client> clients = new();

    /// <summary>Raised, once, for each client that had a number and is here no longer, with what went over its link in all.</summary>
    internal event Action<LinkTraffic>? Gone;

    /// <summary>All, in the order in which they came.</summary>
    internal List<Client> All => clients;

    /// <summary>How many are in.</summary>
    internal int SeatedCount
    {
        get
        {
            int count = 0;
            foreach (Client client in clients)
            {
                count += client.Peer > 0 ? 1 : 0;
            }

            return count;
        }
    }

    /// <summary>The one with that link; a loop, since a delegate would be allocated for every datagram.</summary>
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

    /// <summary>The one with that number.</summary>
    internal Client? Seated(byte player) => clients.Find(j => j.Peer == player);

    /// <summary>Forgets a client.</summary>
    /// <param name="client">Which.</param>
    /// <param name="why">Its number is kept for it unless it left or was sent away.</param>
    /// <returns>False if it was not here any more.</returns>
    internal bool Disconnect(Client client, LeaveReason why)
    {
        if (!clients.Remove(client))
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

    /// <summary>Says goodbye to a client, and forgets it.</summary>
    internal void Dismiss(Client client, LeaveReason why)
    {
        sender.SayGoodbye(client.Link, 0, why);
        Disconnect(client, why);
    }

    /// <summary>Sends away all who are meant; how many.</summary>
    internal int SendAway(Predicate<Client> isIt)
    {
        List<Client> all = clients.FindAll(isIt);
        foreach (Client client in all)
        {
            for (int n = 0; n < DatagramSender.Goodbyes; n++)
            {
                sender.SayGoodbye(client.Link, 0, LeaveReason.Kicked);
            }

            Disconnect(client, LeaveReason.Kicked);
        }

        return all.Count;
    }

    /// <summary>Tells everyone that the session is over.</summary>
    internal void Farewell()
    {
        for (int n = 0; n < DatagramSender.Goodbyes; n++)
        {
            foreach (Client client in clients)
            {
                sender.SayGoodbye(client.Link, 0, LeaveReason.HostEnded);
            }
        }
    }
}
