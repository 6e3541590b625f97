using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>One side of the session protocol, the host's or a client's: it handles incoming datagrams and does what is due.</summary>
internal interface ISessionProtocol : IDatagramHandler
{
    /// <summary>The traffic over each link so far.</summary>
    IReadOnlyList<LinkTraffic> Traffic { get; }

    /// <summary>The number of entries of the host's log that this peer has.</summary>
    uint LogLength { get; }

    /// <summary>The number of those that were part of its initial state, and were not sent.</summary>
    uint LogStart { get; }

    /// <summary>Performs an action and queues it for the other peers; see <see cref="Session.Do"/>.</summary>
    ExternalEvent Do(in PlayerAction action, SimTime time);

    /// <summary>Does what is due by the local clock, sending included.</summary>
    void Tend(SimTime now);

    /// <summary>
    /// Does what is due once the world has advanced as far as it could; true if it changed the world, which then steps again at once.
    /// </summary>
    bool TendWorld(SimTime now);

    /// <summary>When something is due next, by the local clock, if nothing arrives.</summary>
    SimTime NextDue(SimTime now);

    /// <summary>What this peer waits for while it does not run, as a sentence; asked only then.</summary>
    string WaitsFor(SimTime now);

    /// <summary>Says goodbye.</summary>
    /// <param name="failure">What failed, as a sentence, which a host tells its clients; null if nothing did.</param>
    void Farewell(string? failure);

    /// <summary>Wipes the keys of all links; nothing can be sent over them any more.</summary>
    void WipeKeys();

    /// <summary>What is said of this peer where its timelines are full and it has no fresh snapshot.</summary>
    string WhenFull { get; }

    /// <summary>Asks for a fresh snapshot to replace an unusable world; false if none is available.</summary>
    bool TryRenew(SessionEnd by, string why);
}
