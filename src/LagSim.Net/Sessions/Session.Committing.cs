using System;
using LagSim.Net.Wire;
using LagSim.Time;

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
    /// <remarks>A world that is behind commits later.</remarks>
    public event Action<CommittedState>? StateCommitted;

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    public CommittedState? Committed => (CommittedState?)committed;

    /// <summary>
    /// When the next state can be committed, if the watermark follows the clock by that much, and the world by as much where it is
    /// behind. A commit that is due before the world is there is not waited for: the world's own steps are.
    /// </summary>
    private protected SimTime NextCommit(SimDuration behind)
    {
        if (schedule is null)
        {
            return SimTime.MaxValue;
        }

        SimTime due = schedule.Next + behind + SimDuration.OneTick;
        return due <= SharedTime.Now && World is not null && World.Simulation.SimulatedTo < due ? SimTime.MaxValue : due;
    }

    /// <summary>Puts the hashes of the newest committed states into an update, back to one that the other is known to have, as many as may travel.</summary>
    /// <returns>The newest instant; <paramref name="after"/> if there is none after it.</returns>
    private protected SimTime PutHashes(UpdateDatagram update, SimTime after)
    {
        if (schedule is null || Committed is not CommittedState newest || newest.Time <= after)
        {
            return after;
        }

        for (SimTime time = newest.Time; time > after && schedule.TryGet(time, out ulong hash) && update.TryAddHash(time, hash); time -= schedule.Interval)
        {
        }

        return newest.Time;
    }

    /// <summary>Notes the states that the host says it has committed.</summary>
    private protected void CompareCommitted(UpdateDatagram update)
    {
        for (int n = update.Hashes.Length - 1; n >= 0; n--) // the oldest first, so that the first that differs is told
        {
            if (schedule is null || State == SessionState.Rejoining)
            {
                return;
            }

            SimTime time = update.HashTime - (schedule.Interval * n);
            if (schedule.TryCompare(time, update.Hashes[n], out CommittedState mine))
            {
                Compare(mine, update.Hashes[n]);
            }
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

        if ((Fault & SessionFault.ForgetsTooEarly) != 0)
        {
            watermark = SimTime.Max(watermark, SharedTime.Now - Options.Window.History);
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
    /// A world that has long to go takes no more memory for it than one that is there: what has been committed to is hashed as the world gets there, and then
    /// forgotten. What the watermark has not passed stays, however old it is: an event of then may still come, and to have forgotten it would be to lose it.
    /// </summary>
    private void ForgetWhileBehind() => Commit(settled);
}
