using System;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Begins a world: the first one, or a fresh copy in the place of one that could not be gone on with. What belongs to one world starts anew
/// with it.
/// </summary>
internal sealed class WorldStart(
    SharedWorld world, CommitTracker commits, EventJournal journal, SessionStatus status, SessionCounters counters,
    SimDuration commitInterval)
{
    /// <summary>Raised once, when there is a world and nothing has happened in it yet.</summary>
    internal event Action? Begun;

    /// <summary>Raised for each fresh copy, with why it was asked for.</summary>
    internal event Action<string>? Renewed;

    /// <summary>Makes the world, once its start is known.</summary>
    internal void Begin(SimTime start)
    {
        bool isFirst = world.Live is null;
        world.Begin(start);
        Tell(isFirst, new CommitSchedule(start, start, commitInterval));
    }

    /// <summary>Makes the world from what it was committed to be.</summary>
    /// <exception cref="SceneException">It is no world of the scene.</exception>
    internal void Begin(WorldSnapshot snapshot)
    {
        bool isFirst = world.Live is null;
        world.Begin(snapshot);
        Tell(isFirst, new CommitSchedule(snapshot.Start, snapshot.Time, commitInterval));
    }

    private void Tell(bool isFirst, CommitSchedule schedule)
    {
        commits.Begin(schedule);
        if (isFirst)
        {
            Begun?.Invoke();
            return;
        }

        journal.Clear();
        counters.Renewals++;
        Renewed?.Invoke(status.RejoiningBecause);
    }
}
