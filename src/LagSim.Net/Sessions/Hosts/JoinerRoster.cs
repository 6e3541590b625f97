using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Everyone to whom a host has a link: those that are in, and those that are still coming in.</summary>
internal sealed class JoinerRoster(PlayerPlaces places, DatagramSender sender, IClock clock)
{
    private readonly List<Joiner> joiners = new();

    /// <summary>Raised, once, for each joiner that had a number and is here no longer, with what went over its link in all.</summary>
    internal event Action<LinkTraffic>? Gone;

    /// <summary>All, in the order in which they came.</summary>
    internal List<Joiner> All => joiners;

    /// <summary>How many are in.</summary>
    internal int SeatedCount
    {
        get
        {
            int count = 0;
            foreach (Joiner joiner in joiners)
            {
                count += joiner.Peer > 0 ? 1 : 0;
            }

            return count;
        }
    }

    /// <summary>The one with that link; a loop, since a delegate would be allocated for every datagram.</summary>
    internal Joiner? Of(ulong session)
    {
        foreach (Joiner joiner in joiners)
        {
            if (joiner.Link.SessionId == session)
            {
                return joiner;
            }
        }

        return null;
    }

    /// <summary>The one with that number.</summary>
    internal Joiner? Seated(byte player) => joiners.Find(j => j.Peer == player);

    /// <summary>Forgets a joiner.</summary>
    /// <param name="joiner">Which.</param>
    /// <param name="why">Its number is kept for it unless it left or was sent away.</param>
    /// <returns>False if it was not here any more.</returns>
    internal bool LetGo(Joiner joiner, LeaveReason why)
    {
        if (!joiners.Remove(joiner))
        {
            return false;
        }

        if (joiner.Peer > 0)
        {
            places[joiner.Peer].Leave(why is not (LeaveReason.Left or LeaveReason.Kicked), joiner.Link.SessionId, why, clock.Now);
            Gone?.Invoke(joiner.Link.Traffic);
        }

        return true;
    }

    /// <summary>Says goodbye to a joiner, and forgets it.</summary>
    internal void Dismiss(Joiner joiner, LeaveReason why)
    {
        sender.SayGoodbye(joiner.Link, 0, why);
        LetGo(joiner, why);
    }

    /// <summary>Sends away all who are meant; how many.</summary>
    internal int SendAway(Predicate<Joiner> isIt)
    {
        List<Joiner> all = joiners.FindAll(isIt);
        foreach (Joiner joiner in all)
        {
            for (int n = 0; n < DatagramSender.Goodbyes; n++)
            {
                sender.SayGoodbye(joiner.Link, 0, LeaveReason.Kicked);
            }

            LetGo(joiner, LeaveReason.Kicked);
        }

        return all.Count;
    }

    /// <summary>Tells everyone that the session is over.</summary>
    internal void Farewell()
    {
        for (int n = 0; n < DatagramSender.Goodbyes; n++)
        {
            foreach (Joiner joiner in joiners)
            {
                sender.SayGoodbye(joiner.Link, 0, LeaveReason.HostEnded);
            }
        }
    }
}
