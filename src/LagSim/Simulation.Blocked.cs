using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>A session's world stops in the middle of an instant that takes long, and is blocked by one that has no end until an event removes the cause.</content>
public sealed partial class Simulation
{
    /// <summary>The instant of which some has happened and the rest has not; the least time there is if there is none.</summary>
    private SimTime partDone = SimTime.MinValue;

    /// <summary>
    /// Whether an advance may stop within an instant, and whether one with more impacts than can be followed blocks the world until an event comes that lies no later;
    /// otherwise an instant happens as a whole, and such a one ends the simulation.
    /// </summary>
    /// <remarks>For a session, whose host removes the cause. A sync test's twin has no way to stop where this world does, so there it has no effect.</remarks>
    internal bool WaitsForLateEvents { get; set; }

    /// <summary>The instant that blocks the world, and why; null if none does.</summary>
    internal EndlessInstantException? Blocked { get; private set; }

    /// <summary>The instant that blocks the world; the latest time there is if none does.</summary>
    internal SimTime BlockedAt => Blocked?.At ?? SimTime.MaxValue;

    /// <summary>Whether a part of an instant has happened, and the rest has not.</summary>
    internal bool IsPartDone => partDone != SimTime.MinValue;

    /// <summary>Not before the first instant that is kept: nothing could be read then.</summary>
    private bool MayWaitBefore(SimTime instant) => WaitsForLateEvents && twin is null && instant > HistoryEdge;

    /// <summary>Lets everything happen up to and including a time, or up to the instant that blocks the world.</summary>
    private void AdvanceAsFarAs(SimTime time)
    {
        long events = long.MaxValue;
        TryAdvanceTo(time, ref events);
    }

    private void BlockAt(EndlessInstantException endless)
    {
        Blocked = endless;
        TakeBackInstant(endless.At);
    }

    /// <summary>Cuts all that has happened in an instant.</summary>
    private void TakeBackInstant(SimTime instant)
    {
        partDone = SimTime.MinValue;
        GoOnToTheEnd();
        TakeBackAll(EventKey.Before(instant));
    }

    /// <summary>An event was added or taken away: it may free a blocked world, and what has happened of a part-done instant is computed again with it.</summary>
    private void Reconsider(SimTime changed)
    {
        if (changed <= BlockedAt)
        {
            Blocked = null;
        }

        if (IsPartDone && changed <= SimTime.Max(partDone, KnownTo) && !faults.Has(HealingFault.LeavesPartOfAnInstant))
        {
            TakeBackInstant(partDone);
        }
    }
}
