using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>
/// Counts the accepted events of hosts' logs that a client was to hear of, from each copy of a world that it got to where it came, and
/// those that it did not.
/// </summary>
/// <remarks>
///  What was missed counts also where a later copy, or another host's world, made up for it: repair is not to hide a fault. It looks at
/// what hosts and clients told of their logs, and adds what clients themselves counted as too late for their worlds.
/// </remarks>
internal sealed class LogCoverage
{
    private readonly Func<SimTime, IEnumerable<uint>> accepted;
    private readonly Func<uint, bool>? isOverlooked;
    private readonly List<Session> sessions = [];
    private readonly HashSet<uint> heard = []; // of the log, since it last began
    private SimTime world; // the start of the one that it is in
    private uint copied; // up to where that log is in its copy
    private uint reached; // up to where it has the log
    private long expected; // by the time it last began
    private long missed;

    /// <summary>Of a client that has no session yet.</summary>
    /// <param name="accepted">
    /// Gives, for the start of a world, the numbers of the entries in its host's log that are accepted events.
    /// </param>
    /// <param name="isOverlooked">Which entries this does not see, to find out whether what is missed is found; null for none.</param>
    public LogCoverage(Func<SimTime, IEnumerable<uint>> accepted, Func<uint, bool>? isOverlooked = null)
    {
        this.accepted = accepted;
        this.isOverlooked = isOverlooked;
    }

    /// <summary>Listens to a session of the client, from before it is stepped; several in turn if the client is started again.</summary>
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

    /// <summary>How many accepted events it was to hear of by now, and how many of those it did not, or too late.</summary>
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
