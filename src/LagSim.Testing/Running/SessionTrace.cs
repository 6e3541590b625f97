using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Invariant;

namespace LagSim.Testing.Running;

/// <summary>A recorder of what one session produces for comparison: its committed states and its worlds.</summary>
internal sealed class SessionTrace
{
    private readonly Session session;
    private readonly LogCoverage? coverage; // null for the host
    private readonly List<CommittedState> committed = [];
    private readonly List<Simulation> wrong = []; // worlds replaced after a desync

    /// <summary>Subscribes to a session. Call it before the first step.</summary>
    /// <param name="session">The host, or a client.</param>
    /// <param name="log">The host's log. A host is recorded into it, a client is compared with it.</param>
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

    /// <summary>The worlds that diverged and were replaced.</summary>
    internal IReadOnlyList<Simulation> Wrong => wrong;

    /// <summary>
    /// For a client, the number of accepted events that never arrived or arrived too late. For the host, the number it lost itself.
    /// </summary>
    internal long Lost => coverage?.Count().Lost ?? session.Counters.EventsLost;

    /// <summary>Compares every committed state with the reference, which has all events on time.</summary>
    internal void CompareCommitted(int peer, Comparison comparison) => committed.ForEach(state => comparison.Take(peer, state));

    /// <summary>Compares the replaced worlds with the reference.</summary>
    internal void CompareWrong(int peer, Comparison comparison) => wrong.ForEach(world => comparison.Take(peer, world));

    /// <summary>Keeps a diverged world before it is replaced, so that a repaired desync still counts.</summary>
    private void Keep(ClientSession client)
    {
        if (client.Counters.StatesDiffered > 0 && client.World is not null)
        {
            wrong.Add(client.World.Simulation);
        }
    }
}
