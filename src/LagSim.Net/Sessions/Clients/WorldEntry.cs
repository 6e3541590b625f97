using System;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Begins a client's world once everything is there: scene, state or start, the shared time, and the number.</summary>
internal sealed class WorldEntry(
    JoinAttempts attempts, HostConnection connection, WorldStart start, SharedClock sharedTime, SessionStatus status,
    IClock clock, SimDuration timeout)
{
    /// <summary>Begins the world if everything is there. Ends the session if the world cannot be begun.</summary>
    /// <param name="told">When the session starts; the earliest instant if the host has not said.</param>
    /// <returns>Whether it has begun.</returns>
    internal bool TryBegin(SimTime told)
    {
        if (attempts.Current is not { Seat: not null, Snapshot: SessionSnapshot joined } attempt)
        {
            return false;
        }

        if (joined.World is WorldSnapshot snapshot)
        {
            try
            {
                start.Begin(snapshot);
            }
            catch (SceneException failure)
            {
                connection.Farewell(isChosen: false);
                status.End(
                    SessionEnd.Failed, $"The state that the {connection.Name} sent is no world of its scene. {failure.Message}");
                return false;
            }
        }
        else if (told == SimTime.MinValue)
        {
            return false; // not decided yet
        }
        else if (told < EarliestStart(attempt))
        {
            connection.Farewell(isChosen: false);
            status.End(SessionEnd.Failed, FormattableString.Invariant(
                $"The {connection.Name} says that the session began {(sharedTime.Now - told).ToSeconds():0} s ago and sent no")
                + " state of it: that is more than history and time-out allow.");
            return false;
        }
        else
        {
            start.Begin(told);
        }

        attempts.Finish();
        return true;
    }

    /// <summary>The earliest start to accept; simulating from any earlier one would take unbounded time.</summary>
    /// <remarks>
    /// A client that joins later than the history after the start gets a state with the scene. Without one, the start lies at most the
    /// history, plus the timeout for clocks and snapshots, before it asked to join.
    /// </remarks>
    private SimTime EarliestStart(JoinAttempt attempt) =>
        sharedTime.Now - (clock.Now - attempt.Began) - timeout
        - (connection.LongestHistory < LatencyCompensationWindow.MaxHistory ? connection.LongestHistory : LatencyCompensationWindow.MaxHistory);
}
