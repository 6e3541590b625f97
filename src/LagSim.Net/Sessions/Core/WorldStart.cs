using System;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Begins a world: the first one, or a fresh snapshot in place of an unusable one. State that belongs to one world is reset with it.
/// </summary>
internal sealed class WorldStart(
    SharedWorld world, CommitTracker commits, EventJournal journal, SessionStatus status, SessionCounters counters,
    SimDuration commitInterval)
{
    /// <summary>Raised once, when the world exists and nothing has happened in it yet.</summary>
    internal event Action? Begun;

    /// <summary>Raised for each fresh snapshot, with the reason for requesting it.</summary>
    internal event Action<string>? Renewed;

    /// <summary>Creates the world, once its start is known.</summary>
    internal void Begin(SimTime start)
    {
        bool isFirst = world.Live is null;
        world.Begin(start);
        Tell(isFirst, new CommitSchedule(start, start, commitInterval));
    }

    /// <summary>Creates the world from a committed state.</summary>
    /// <exception cref="SceneException">The snapshot is not a world of the scene.</exception>
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
