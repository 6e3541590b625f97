using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>
/// Counts the accepted events of the hosts' logs that a client should have received, from each snapshot it got to where its log ends, and
/// those that it missed.
/// </summary>
/// <remarks>
/// A missed event counts even if a later snapshot, or another host's world, made up for it: a repair must not hide a fault. It uses the
/// logs that hosts and clients report, and adds what clients themselves counted as too late for their worlds.
/// </remarks>
internal sealed class LogCoverage
{
    private readonly Func<SimTime, IEnumerable<uint>> accepted;
    private readonly Func<uint, bool>? isOverlooked;
    private readonly List<Session> sessions = [];
    private readonly HashSet<uint> heard = []; // entries received since the log last began
    private SimTime world; // the start of the world that it is in
    private uint copied; // the last entry included in its snapshot
    private uint reached; // the last entry that it has
    private long expected; // as of when it last began
    private long missed;

    /// <summary>Creates the coverage of a client that has no session yet.</summary>
    /// <param name="accepted">
    /// Returns, for the start of a world, the numbers of the entries in its host's log that are accepted events.
    /// </param>
    /// <param name="isOverlooked">Entries to overlook, to check that a miss is found; null for none.</param>
    public LogCoverage(Func<SimTime, IEnumerable<uint>> accepted, Func<uint, bool>? isOverlooked = null)
    {
        this.accepted = accepted;
        this.isOverlooked = isOverlooked;
    }

    /// <summary>Follows a session of the client, from before it is stepped; several in turn if the client is restarted.</summary>
    public void Follow(Session session)
    {
        ArgumentNullException.ThrowIfNull(session);
        sessions.Add(session);
        session.Begun += () => Begin(session);
        session.Renewed += _ => Begin(session);
        session.Logged += entry =>
        {
            reached = entry.Index;
            if (isOverlooked?.Invoke(entry.Index) != true)
            {
                heard.Add(entry.Index);
            }
        };
    }

    /// <summary>Returns how many accepted events it should have received by now, and how many of those it missed or got too late.</summary>
    public (long Expected, long Lost) Count()
    {
        (long now, long missing) = CountSinceItBegan();
        return (expected + now, missed + missing + sessions.Sum(session => session.Counters.EventsLost));
    }

    private void Begin(Session session)
    {
        (long now, long missing) = CountSinceItBegan();
        expected += now;
        missed += missing;
        heard.Clear();
        world = session.World!.Simulation.Start;
        copied = reached = session.LogStart;
    }

    private (long Expected, long Missed) CountSinceItBegan()
    {
        uint[] due = reached == copied ? [] : [.. accepted(world).Where(index => index > copied && index <= reached)];
        return (due.Length, due.Count(index => !heard.Contains(index)));
    }
}
