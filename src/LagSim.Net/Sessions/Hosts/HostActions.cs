using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Performs the host's own actions, in its world and in the log at once, since no other peer has to accept them.</summary>
internal sealed class HostActions(LocalActions actions, AuthoritativeLog log)
{
    /// <summary>Performs an action at a shared time; see <see cref="Session.Do"/>.</summary>
    internal ExternalEvent Do(in PlayerAction action, SimTime time)
    {
        actions.ThrowIfNotRunning();
        ExternalEvent external = actions.Submit(action, time);
        log.Record(external, Verdict.Accepted, hasEffect: true);
        return external;
    }

    /// <summary>Says something of a player, at a shared time that nothing is committed of. The world must exist, and its rules hear it.</summary>
    internal void Announce(PlayerEvent player, SimTime time) => log.Record(actions.Announce(player, time), Verdict.Accepted, hasEffect: true);
}
