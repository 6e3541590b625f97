using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>What the host does itself: in its world and in the log at once, since nobody else has to accept it.</summary>
internal sealed class HostActions(LocalActions actions, AuthoritativeLog log)
{
    /// <summary>Does something at a shared time; see <see cref="Session.Do"/>.</summary>
    internal ExternalEvent Do(in PlayerAction action, SimTime time)
    {
        actions.ThrowIfNotRunning();
        ExternalEvent external = actions.Submit(action, time);
        log.Record(external, Verdict.Accepted, hasEffect: true);
        return external;
    }
}
