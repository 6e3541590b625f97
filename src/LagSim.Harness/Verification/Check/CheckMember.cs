using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Running;

namespace LagSim.Harness.Verification.Check;

/// <summary>One peer of a seeded session while it is played.</summary>
internal sealed class CheckMember
{
    private readonly List<HealImpacts> heals = [];

    /// <summary>Subscribes to a session. Call it before the first step.</summary>
    /// <param name="peer">The peer's address, which is also its index among the drawn players.</param>
    /// <param name="player">The player as drawn.</param>
    /// <param name="session">The session.</param>
    /// <param name="number">The session's index among the stepped sessions.</param>
    /// <param name="log">The host's log.</param>
    internal CheckMember(int peer, CheckPlayer player, Session session, int number, HostLog log)
    {
        Peer = peer;
        Session = session;
        Number = number;
        if (player.IndexAbove is int bodies)
        {
            session.Parts.World.ChangeOptions(options => options.WithBruteForceLimit(bodies));
        }

        session.Begun += Watch;
        session.Renewed += _ => Watch();
        Trace = new SessionTrace(session, log);
    }

    /// <summary>The peer's address, which is also its index among the drawn players.</summary>
    internal int Peer { get; }

    internal Session Session { get; }

    /// <summary>The session's index among the stepped sessions.</summary>
    internal int Number { get; }

    /// <summary>The recorded states and worlds.</summary>
    internal SessionTrace Trace { get; }

    /// <summary>The impacts that heals changed, for each of its worlds.</summary>
    internal IReadOnlyList<HealImpacts> Heals => heals;

    internal bool HasGone { get; set; }

    /// <summary>Whether its process is stalled.</summary>
    internal bool IsStopped { get; set; }

    private void Watch() =>
        heals.Add(new HealImpacts(Session.World!.Simulation, report => report.From < Session.SharedTime.Now));
}
