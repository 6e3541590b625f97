using System;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>What will not change any more of the world: hashed, compared with what the host says, and then forgotten.</summary>
/// <param name="world">The world.</param>
/// <param name="sharedTime">The session's time.</param>
/// <param name="status">Where the session stands: what the host says of a world that is given up is not compared.</param>
/// <param name="counters">What is counted.</param>
/// <param name="extraHistory">How much longer timelines are kept than events may be late.</param>
internal sealed class CommitTracker(
    SharedWorld world, SharedClock sharedTime, SessionStatus status, SessionCounters counters, SimDuration extraHistory)
{
    private volatile object? committed; // a boxed state: other threads read it whole
    private SimTime settled = SimTime.MinValue; // the watermark that was last committed to
    private CommitSchedule? schedule;

    /// <summary>Raised for every committed state, in order.</summary>
    internal event Action<CommittedState>? Committed;

    /// <summary>Raised for every committed state that was held against the hash that the host told for it, with that hash.</summary>
    internal event Action<CommittedState, ulong>? Compared;

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    internal CommittedState? Newest => (CommittedState?)committed;

    /// <summary>What a watermark is taken for; only a test that is to see it missed puts another rule here.</summary>
    internal Func<SimTime, SimTime>? WatermarkRule { get; set; }

    /// <summary>Starts anew with another world.</summary>
    internal void Begin(CommitSchedule ofTheWorld)
    {
        settled = SimTime.MinValue;
        schedule = ofTheWorld;
    }

    /// <summary>
    /// When the next state can be committed, if the watermark follows the clock by that much, and the world by as much where it is
    /// behind. A commit that is due before the world is there is not waited for: the world's own steps are.
    /// </summary>
    internal SimTime NextDue(SimDuration behind)
    {
        if (schedule is null)
        {
            return SimTime.MaxValue;
        }

        SimTime due = schedule.Next + behind + SimDuration.OneTick;
        return due <= sharedTime.Now && world.Live is not null && world.Live.Simulation.SimulatedTo < due ? SimTime.MaxValue : due;
    }

    /// <summary>
    /// Puts the hashes of the newest committed states into an update, back to one that the other is known to have, as many as may travel.
    /// </summary>
    /// <returns>The newest instant; <paramref name="after"/> if there is none after it.</returns>
    internal SimTime PutHashes(UpdateDatagram update, SimTime after)
    {
        if (schedule is null || Newest is not CommittedState newest || newest.Time <= after)
        {
            return after;
        }

        SimTime time = newest.Time;
        while (time > after && schedule.TryGet(time, out ulong hash) && update.TryAddHash(time, hash))
        {
            time -= schedule.Interval;
        }

        return newest.Time;
    }

    /// <summary>Notes the states that the host says it has committed.</summary>
    internal void Compare(UpdateDatagram update)
    {
        for (int n = update.Hashes.Length - 1; n >= 0; n--) // the oldest first, so that the first that differs is told
        {
            if (schedule is null || status.IsRejoining)
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

    /// <summary>
    /// Nothing before the watermark will change any more; hash what is due, and forget it, but for what the options want kept.
    /// </summary>
    internal void Commit(SimTime watermark)
    {
        if (world.Live is null || schedule is null)
        {
            return;
        }

        watermark = WatermarkRule?.Invoke(watermark) ?? watermark;
        settled = SimTime.Max(settled, watermark);
        while (schedule.Next < watermark && schedule.Next <= world.Live.Simulation.Horizon)
        {
            CommittedState state = schedule.Take(world.Live.Simulation);
            committed = state;
            if (schedule.TryCompare(state, out ulong theirs))
            {
                Compare(state, theirs);
            }

            Committed?.Invoke(state);
        }

        // What is still to be hashed is kept, and what is still to be shown.
        SimDuration kept = extraHistory + world.DisplayDelay;
        SimTime oldest = SimTime.Max(watermark, world.Live.Simulation.HistoryEdge + kept) - kept;
        world.Live.Simulation.DropHistoryBefore(SimTime.Min(oldest, schedule.Next));
    }

    /// <summary>
    /// A world that has long to go takes no more memory for it than one that is there: what has been committed to is hashed as the world
    /// gets there, and then
    /// forgotten. What the watermark has not passed stays, however old it is: an event of then may still come, and to have forgotten it
    /// would be to lose it.
    /// </summary>
    internal void ForgetWhileBehind() => Commit(settled);

    private void Compare(in CommittedState own, ulong theirs)
    {
        counters.Count(own.StateHash == theirs, own.Time);
        Compared?.Invoke(own, theirs);
    }
}
