using System;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Commits the part of the world that can no longer change: hashes it, compares it with the host's hashes, and then drops its history.
/// </summary>
/// <param name="world">The world.</param>
/// <param name="sharedTime">The session's time.</param>
/// <param name="status">Where the session stands; hashes for an abandoned world are not compared.</param>
/// <param name="counters">The session's counters.</param>
/// <param name="extraHistory">How long timelines are kept beyond the lateness limit of events.</param>
internal sealed class CommitTracker(
    SharedWorld world, SharedClock sharedTime, SessionStatus status, SessionCounters counters, SimDuration extraHistory)
{
    private volatile object? committed; // boxed, so that other threads read it whole
    private SimTime settled = SimTime.MinValue; // the last committed watermark
    private CommitSchedule? schedule;

    /// <summary>Raised for every committed state, in order.</summary>
    internal event Action<CommittedState>? Committed;

    /// <summary>Raised for every committed state that was compared with the host's hash, with that hash.</summary>
    internal event Action<CommittedState, ulong>? Compared;

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    internal CommittedState? Newest => (CommittedState?)committed;

    /// <summary>Replaces the watermark; set only by tests that check that a wrong one is noticed.</summary>
    internal Func<SimTime, SimTime>? WatermarkRule { get; set; }

    /// <summary>Starts over with another world.</summary>
    internal void Begin(CommitSchedule ofTheWorld)
    {
        settled = SimTime.MinValue;
        schedule = ofTheWorld;
    }

    /// <summary>
    /// When the next state can be committed, if the watermark trails the clock by this much, and the world by as much where it is behind. A
    /// commit that is due before the world gets there is not waited for, since the world's own steps are.
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
    /// Puts the hashes of the newest committed states into an update, back to one that the other peer is known to have, as many as fit.
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

    /// <summary>Compares the states that the host has committed.</summary>
    internal void Compare(UpdateDatagram update)
    {
        for (int n = update.Hashes.Length - 1; n >= 0; n--) // the oldest first, so that the first difference is reported
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
    /// Hashes what is due before the watermark, where nothing changes any more, and drops the history that the options do not keep.
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

        // History that is still to be hashed or displayed is kept.
        SimDuration kept = extraHistory + world.DisplayDelay;
        SimTime oldest = SimTime.Max(watermark, world.Live.Simulation.HistoryEdge + kept) - kept;
        world.Live.Simulation.DropHistoryBefore(SimTime.Min(oldest, schedule.Next));
    }

    /// <summary>
    /// Bounds the memory of a world that is far behind: committed history is hashed as the world gets there, and then dropped. History
    /// after the watermark stays, however old, because an event of that time may still arrive and would otherwise be lost.
    /// </summary>
    internal void ForgetWhileBehind() => Commit(settled);

    private void Compare(in CommittedState own, ulong theirs)
    {
        counters.Count(own.StateHash == theirs, own.Time);
        Compared?.Invoke(own, theirs);
    }
}
