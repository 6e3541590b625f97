using System;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <content>What will not change any more: hashed, compared with what the host says, and then forgotten.</content>
public abstract partial class Session
{
    private volatile object? committed; // a boxed state: other threads read it whole
    private SimTime settled = SimTime.MinValue; // the watermark that was last committed to
    private CommitSchedule? schedule;

    /// <summary>
    /// Raised on the session's thread for every committed state, in order; see <see cref="SessionOptions.CommitInterval"/>. Handlers must not throw.
    /// </summary>
    /// <remarks>A world that is behind commits later; where it had to forget an instant before that could be committed, none is raised for it.</remarks>
    public event Action<CommittedState>? StateCommitted;

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    public CommittedState? Committed => (CommittedState?)committed;

    /// <summary>When the next state can be committed, if the watermark follows the clock by that much.</summary>
    private protected SimTime NextCommit(SimDuration behind) =>
        schedule is null ? SimTime.MaxValue : schedule.Next + behind + SimDuration.OneTick;

    /// <summary>Notes the state that the host says it has committed.</summary>
    private protected void CompareCommitted(SimTime time, ulong stateHash)
    {
        if (schedule is not null && schedule.TryCompare(time, stateHash, out CommittedState mine))
        {
            Compare(mine, stateHash);
        }
    }

    /// <summary>An own committed state was held against the hash that the host told for it.</summary>
    private protected virtual void OnCompared(in CommittedState own, ulong theirs)
    {
    }

    private void Compare(in CommittedState own, ulong theirs)
    {
        Counters.Count(own.StateHash == theirs, own.Time);
        OnCompared(own, theirs);
    }

    /// <summary>Nothing before the watermark will change any more; hash what is due, and forget it, but for what the options want kept.</summary>
    private protected void Commit(SimTime watermark)
    {
        if (World is null || schedule is null)
        {
            return;
        }

        settled = SimTime.Max(settled, watermark);
        while (schedule.Next < watermark && schedule.Next <= World.Simulation.Horizon)
        {
            CommittedState state = schedule.Take(World.Simulation);
            committed = state;
            if (schedule.TryCompare(state, out ulong theirs))
            {
                Compare(state, theirs);
            }

            StateCommitted?.Invoke(state);
        }

        // What is still to be hashed is kept, and what is still to be shown.
        SimDuration kept = Options.ExtraHistory + DisplayDelay;
        SimTime oldest = SimTime.Max(watermark, World.Simulation.HistoryEdge + kept) - kept;
        World.Simulation.DropHistoryBefore(SimTime.Min(oldest, schedule.Next));
    }

    /// <summary>
    /// A world that has long to go takes no more memory for it than one that is there: what has been committed to is hashed as the world gets there, and
    /// what is older than any event that can still come is forgotten, committed or not.
    /// </summary>
    private void ForgetWhileBehind(SimTime shared)
    {
        Commit(settled);
        Simulation simulation = World!.Simulation;
        SimTime oldest = SimTime.Min(shared - LatencyCompensationWindow.MaxHistory - Options.Timeout - Options.ExtraHistory, simulation.SimulatedTo);
        if (oldest > simulation.HistoryEdge)
        {
            schedule!.SkipTo(oldest);
            simulation.DropHistoryBefore(oldest);
        }
    }
}
