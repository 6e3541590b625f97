using System;
using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Performs this peer's own actions: stamps them with its number and a time, checks them against rights and limits, and applies them to its
/// own world at once.
/// </summary>
internal sealed class LocalActions(PlayerIdentity self, SessionStatus status, SharedClock sharedTime, SharedWorld world)
{
    /// <exception cref="InvalidOperationException">The session is not running.</exception>
    internal void ThrowIfNotRunning()
    {
        if (!status.HasEnded && sharedTime.IsSet && world.HasBegunBy(sharedTime.Now))
        {
            status.BeginRunning();
        }

        if (status.State != SessionState.Running || world.Live is null)
        {
            throw new InvalidOperationException(status.HasEnded
                ? $"Nothing can be done any more: the session has ended. {status.EndReason}"
                : status.IsRejoining ? $"Nothing can be done until this peer is in again. {status.RejoiningBecause}"
                : $"Nothing can be done while the session is {status.State}; wait until it is Running.");
        }
    }

    /// <summary>Performs an action at a shared time, in a running session; it is not sent to the other peers yet.</summary>
    /// <exception cref="InvalidOperationException">That time is committed already; nothing happened.</exception>
    /// <exception cref="SceneException">The action may not enter the world, or this peer may not do it here; nothing happened.</exception>
    /// <exception cref="SimulationException">The world cannot be simulated with the action.</exception>
    internal ExternalEvent Submit(in PlayerAction action, SimTime time)
    {
        ExternalEvent external = action.Stamp(time, self.Number, self.LastSequence + 1);
        EventRights.Throw(external, world.Scene!, world.Live!.Simulation.PlayersOf(external.Body));
        if (world.Limits.WhyNot(external, world.Live!.Simulation, external.Time, out string sentence) != Verdict.Accepted)
        {
            throw new SceneException(sentence);
        }

        return Submit(external);
    }

    /// <summary>Says something of a player to the world's rules, as this host's next event; the world must exist.</summary>
    internal ExternalEvent Announce(PlayerEvent player, SimTime time) => Submit(player.Stamp(time, self.LastSequence + 1));

    private ExternalEvent Submit(in ExternalEvent external)
    {
        world.Submit(external);
        self.NoteEvent();
        return external;
    }
}
