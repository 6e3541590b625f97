using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Invariant;

namespace LagSim.Testing.Running;

/// <summary>What one session of a run leaves behind to be compared: what it committed, and its worlds.</summary>
internal sealed class SessionTrace
{
    private readonly Session session;
    private readonly LogCoverage? coverage; // null for the host
    private readonly List<CommittedState> committed = [];
    private readonly List<Simulation> wrong = []; // its worlds that turned out to differ, and were replaced

    /// <summary>Follows a session, from before it is stepped.</summary>
    /// <param name="session">The host, or a client.</param>
    /// <param name="log">What the host says; the host itself is followed by it.</param>
    internal SessionTrace(Session session, HostLog log)
    {
        this.session = session;
        session.StateCommitted += committed.Add;
        if (session is ClientSession client)
        {
            coverage = new LogCoverage(_ => log.AcceptedEntries);
            coverage.Follow(client);
            client.Interrupted += _ => Keep(client);
        }
        else
        {
            log.Follow(session);
        }
    }

    /// <summary>Its worlds that turned out to differ, and were replaced.</summary>
    internal IReadOnlyList<Simulation> Wrong => wrong;

    /// <summary>How many accepted events a client was to hear of and did not, or too late; of the host how many it lost itself.</summary>
    internal long Lost => coverage?.Count().Lost ?? session.Counters.EventsLost;

    /// <summary>Holds all that was committed against the world that never had a delay.</summary>
    internal void CompareCommitted(int peer, Comparison comparison) => committed.ForEach(state => comparison.Take(peer, state));

    /// <summary>Holds the worlds that were replaced against it.</summary>
    internal void CompareWrong(int peer, Comparison comparison) => wrong.ForEach(world => comparison.Take(peer, world));

    /// <summary>What is repaired still counts: the world as it was is held against the one that never had a delay.</summary>
    private void Keep(ClientSession client)
    {
        if (client.Counters.StatesDiffered > 0 && client.World is not null)
        {
            wrong.Add(client.World.Simulation);
        }
    }
}
