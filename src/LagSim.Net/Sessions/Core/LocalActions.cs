using System;
using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// What this peer does itself: stamped with its number and a time, held against rights and limits, and brought into its own world at once.
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

    /// <summary>Does something, at a shared time, in a session that is running; the others have not heard of it yet.</summary>
    /// <exception cref="InvalidOperationException">That time is committed already; nothing happened.</exception>
    /// <exception cref="SceneException">It may not enter the world, or this peer may not do it here; nothing happened.</exception>
    /// <exception cref="SimulationException">The world cannot be simulated with it.</exception>
    internal ExternalEvent Submit(in PlayerAction action, SimTime time)
    {
        ExternalEvent external = action.Stamp(time, self.Number, self.LastSequence + 1);
        EventRights.Throw(external, world.Scene!);
        if (world.Limits.WhyNot(external, world.Live!.Simulation, external.Time, out string sentence) != Verdict.Accepted)
        {
            throw new SceneException(sentence);
        }

        world.Submit(external);
        self.NoteEvent();
        return external;
    }
}
