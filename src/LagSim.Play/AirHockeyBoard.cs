using System;
using System.Collections.Generic;
using AirHockey;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>What one peer sees of a match of air hockey beside its bodies: the score, who plays, what the rules tell, what else lies on the
/// table.</summary>
/// <remarks>For a peer of any session of the game, whether it plays or only looks on. Each frame calls <see cref="Look"/>. Points are seen
/// from above, in metres: x to the right, y up. Not thread-safe.</remarks>
internal sealed class AirHockeyBoard
{
    private readonly Session session;
    private readonly List<AirHockeyThing> things = [];
    private readonly HashSet<byte> toldOf = []; // the peers that have been in the roster since it began to look
    private Match match;

    /// <summary>Begins to look.</summary>
    /// <param name="session">The session, which runs.</param>
    /// <param name="notices">Those that the session was given.</param>
    internal AirHockeyBoard(Session session, RuleNotices notices)
    {
        this.session = session;
        News = new AirHockeyNews(notices, Players, NameOf);
        foreach (RosterMember one in session.Roster)
        {
            toldOf.Add(one.Number);
        }

        session.RosterChanged += change => toldOf.Add(change.Member.Number); // also in a tab that is hidden, which has no frames
    }

    /// <summary>How many play.</summary>
    internal int Players => Table.PlayersOf(session.Scene!);

    /// <summary>What the rules have told.</summary>
    internal AirHockeyNews News { get; }

    /// <summary>The match, as it stands at the instant that is shown.</summary>
    internal ref readonly Match Match => ref match;

    /// <summary>How long play goes on, in seconds of the world; below zero the next goal wins.</summary>
    internal double SecondsLeft { get; private set; }

    /// <summary>What lies on the table beside the puck and the mallets.</summary>
    internal IReadOnlyList<AirHockeyThing> Things => things;

    /// <summary>What a player calls itself; null if it has said nothing, is not in the session now, or another player says the same.</summary>
    /// <param name="player">Its number, from 0.</param>
    internal string? NameOf(int player)
    {
        string? name = RosterName(player);
        for (int other = 0; other < Players; other++)
        {
            name = other != player && string.Equals(RosterName(other), name, StringComparison.OrdinalIgnoreCase) ? null : name;
        }

        return name;
    }

    /// <summary>Whether a player is there, as far as this peer has been told.</summary>
    /// <param name="player">Its number, from 0.</param>
    internal PlayerPresence PresenceOf(int player)
    {
        byte peer = Table.PeerOf(session.Scene!, player);
        bool isTold = false;
        foreach (RosterMember one in session.Roster)
        {
            if (one.Number == peer)
            {
                return one.SilentSince is null ? PlayerPresence.Here : PlayerPresence.Silent;
            }

            isTold |= one.Number == session.Peer;
        }

        return !isTold ? PlayerPresence.Here // who is not in the roster itself has none yet
            : toldOf.Contains(peer) ? PlayerPresence.Away : PlayerPresence.NotYet;
    }

    /// <summary>A frame: reads what is shown.</summary>
    /// <param name="display">Where bodies are drawn.</param>
    internal void Look(DisplayOffsets display)
    {
        SimTime shown = session.DisplayTime;
        News.Take(shown);
        if (session.World is not LiveWorld world)
        {
            return;
        }

        RenderSnapshot snapshot = world.RenderSnapshots.Latest();
        if (!snapshot.TryReadRules(shown, out Match now))
        {
            return;
        }

        match = now;
        SecondsLeft = ((double)match.Ends / SimDuration.TicksPerSecond) - (shown - snapshot.Start).ToSeconds();
        things.Clear();
        for (int n = 0; n < snapshot.BodyCount; n++)
        {
            BodyId body = snapshot.BodyAt(n);
            ulong tag = snapshot.TagOf(body);
            if (tag != Table.MalletTag && body != Table.Puck && display.TryRead(body, out DrawnBody drawn))
            {
                (double x, double y) = AirHockeyGame.ToView(drawn.Position);
                things.Add(new AirHockeyThing(tag < Table.PrizeTag ? null : (PrizeKind)(tag - Table.PrizeTag), x, y));
            }
        }
    }

    private string? RosterName(int player)
    {
        byte peer = Table.PeerOf(session.Scene!, player);
        foreach (RosterMember one in session.Roster)
        {
            if (one.Number == peer && one.Name.Length > 0)
            {
                return one.Name;
            }
        }

        return null;
    }
}
