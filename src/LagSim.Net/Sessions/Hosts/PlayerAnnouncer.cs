using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Tells the scene's rules who joined, is away, returned or left, by events of the host in its log. Nothing is logged for rules that do not
/// hear of players.
/// </summary>
/// <remarks>
/// Once a step it holds what the world was told of each number against who has it, so rules hear of nothing twice, and of nobody who came and
/// went in one step. Those who are in when the world begins are told at its start.
/// </remarks>
internal sealed class PlayerAnnouncer
{
    private readonly PlayerEvent?[] told = new PlayerEvent?[SessionOptions.MaxNumber + 1]; // the last of each number; null for nobody
    private readonly ClientRoster roster;
    private readonly PlayerPlaces places;
    private readonly ClientTimeouts timeouts;
    private readonly HostActions actions;
    private readonly SessionParts parts;
    private readonly bool isHeard;
    private readonly ulong own;

    internal PlayerAnnouncer(ClientRoster roster, PlayerPlaces places, ClientTimeouts timeouts, HostActions actions, SessionParts parts)
    {
        this.roster = roster;
        this.places = places;
        this.timeouts = timeouts;
        this.actions = actions;
        this.parts = parts;
        own = places.Ids.OfHost;
        isHeard = parts.World.Scene!.Rules?.HearsPlayers == true;
    }

    /// <summary>Logs what has changed.</summary>
    internal void Tend(SimTime now)
    {
        if (!isHeard || parts.World.Live is null)
        {
            return;
        }

        for (byte number = 1; number < told.Length; number++)
        {
            TellIfGone(number, now); // first, so that who changes his number is never there twice
        }

        Tell(0, own, parts.Options.Name, parts.Options.Role);
        foreach (Client client in roster.All)
        {
            if (client.Peer > 0 && !timeouts.IsSilent(client, now))
            {
                Tell(client.Peer, places[client.Peer].Identity, roster.NameOf(client), (PeerRole)client.Claim.Role);
            }
        }
    }

    /// <summary>When somebody who is away has left, if nothing else happens, by the local clock.</summary>
    internal SimTime NextDue()
    {
        SimTime due = SimTime.MaxValue;
        for (byte number = 1; number < told.Length; number++)
        {
            bool isWaitedFor = told[number]?.Kind == PlayerEventKind.Away && places[number].LeftAt is not null;
            due = isWaitedFor ? SimTime.Min(due, places.KeptUntil(number) + SimDuration.OneTick) : due;
        }

        return due;
    }

    private void TellIfGone(byte number, SimTime now)
    {
        if (told[number] is not PlayerEvent known)
        {
            return;
        }

        PlayerPlaces.Place place = places[number];
        Client? client = roster.Seated(number);
        if (place.Identity != known.Identity || (client is null && !places.IsKept(place, now)))
        {
            Log(PlayerEventKind.Left, known);
            told[number] = null;
        }
        else if (known.Kind != PlayerEventKind.Away && (client is null || timeouts.IsSilent(client, now)))
        {
            told[number] = Log(PlayerEventKind.Away, known);
        }
    }

    /// <summary>Tells of somebody who is in, if the world has not been told or was told something else.</summary>
    private void Tell(byte number, ulong identity, string name, PeerRole role)
    {
        PlayerEvent? known = told[number];
        if (known is null || known.Kind == PlayerEventKind.Away || known.Name != name || known.Role != role)
        {
            told[number] = Log(new PlayerEvent(known is null ? PlayerEventKind.Joined : PlayerEventKind.Returned, number, identity, name, role));
        }
    }

    private PlayerEvent Log(PlayerEventKind kind, PlayerEvent of) => Log(new PlayerEvent(kind, of.Number, of.Identity, of.Name, of.Role));

    private PlayerEvent Log(PlayerEvent player)
    {
        actions.Announce(player, SimTime.Max(parts.SharedTime.Now, parts.World.Live!.Simulation.Start));
        return player;
    }
}
