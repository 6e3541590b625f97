using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Testing.Running;

namespace LagSim.Harness.Verification.Check;

/// <summary>One peer of a drawn session as that goes on.</summary>
internal sealed class CheckMember
{
    private readonly List<HealImpacts> heals = [];

    /// <summary>Follows a session, from before it is stepped.</summary>
    /// <param name="peer">Its address, and its index among the players that were drawn.</param>
    /// <param name="player">The player as it was drawn.</param>
    /// <param name="session">The session.</param>
    /// <param name="number">Its number among those that are stepped.</param>
    /// <param name="log">What the host says.</param>
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

    /// <summary>Its address, and its index among the players that were drawn.</summary>
    internal int Peer { get; }

    internal Session Session { get; }

    /// <summary>Its number among those that are stepped.</summary>
    internal int Number { get; }

    /// <summary>What is to be compared of it.</summary>
    internal SessionTrace Trace { get; }

    /// <summary>What healing did in each of its worlds.</summary>
    internal IReadOnlyList<HealImpacts> Heals => heals;

    internal bool HasGone { get; set; }

    /// <summary>Whether its process stands still.</summary>
    internal bool IsStopped { get; set; }

    private void Watch() =>
        heals.Add(new HealImpacts(Session.World!.Simulation, report => report.From < Session.SharedTime.Now));
}
