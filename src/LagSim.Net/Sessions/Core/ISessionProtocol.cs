using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>One side of the session protocol, the host's or a client's: what is done with what comes in, and what is due.</summary>
internal interface ISessionProtocol : IDatagramHandler
{
    /// <summary>What went over each link so far.</summary>
    IReadOnlyList<LinkTraffic> Traffic { get; }

    /// <summary>How many lines of the host's log this peer has.</summary>
    uint LogLength { get; }

    /// <summary>How many of them were in the state that this peer began from, and were not told.</summary>
    uint LogStart { get; }

    /// <summary>Does something, and sees to it that the others hear of it; see <see cref="Session.Do"/>.</summary>
    ExternalEvent Do(in PlayerAction action, SimTime time);

    /// <summary>Whatever is due by the own clock, sending included.</summary>
    void Tend(SimTime now);

    /// <summary>
    /// Whatever is to be done when the world has got as far as it could; true if it changed the world, which then goes on at once.
    /// </summary>
    bool TendWorld(SimTime now);

    /// <summary>When something is due next, by the own clock, if nothing comes in.</summary>
    SimTime NextDue(SimTime now);

    /// <summary>Says goodbye.</summary>
    void Farewell();

    /// <summary>
    /// Asks for a fresh copy of the world in place of one that cannot be gone on with; false where there is none to be had.
    /// </summary>
    bool TryRenew(SessionEnd by, string why);
}
