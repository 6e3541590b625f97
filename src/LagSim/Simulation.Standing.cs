using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>A world that stops within an instant, or stands before one without end, and waits for an event that removes the cause.</content>
public sealed partial class Simulation
{
    /// <summary>The instant of which some has happened and the rest has not; the least time there is if there is none.</summary>
    private SimTime within = SimTime.MinValue;

    /// <summary>Before which instant it stands; the latest there is if it does not.</summary>
    private SimTime standsBefore = SimTime.MaxValue;

    /// <summary>
    /// Whether an advance may stop within an instant, and whether the world stands before one that has more impacts than can be followed, until an event comes that
    /// lies no later; otherwise an instant happens as a whole, and such a one ends the simulation. For a session, whose host takes away what did it.
    /// </summary>
    internal bool WaitsForNews { get; set; }

    /// <summary>Why it stands before an instant; null if it does not.</summary>
    internal EndlessInstantException? Standing { get; private set; }

    /// <summary>Whether a part of an instant has happened, and the rest has not.</summary>
    internal bool IsWithinInstant => within != SimTime.MinValue;

    /// <summary>Lets everything happen up to and including a time, or up to an instant before which the world stands then.</summary>
    private void AdvanceAsFarAs(SimTime time)
    {
        long events = long.MaxValue;
        TryAdvanceTo(time, ref events);
    }

    /// <summary>Takes back what has happened in an instant without end.</summary>
    private void StandBefore(EndlessInstantException endless)
    {
        Standing = endless;
        standsBefore = endless.At;
        TakeBackInstant(endless.At);
    }

    private void TakeBackInstant(SimTime instant)
    {
        within = SimTime.MinValue;
        GoOnToTheEnd();
        TakeBackAll(new EventKey(instant, 0, EventKind.Spawn, default, default, 0, 0)); // what is there from the start stays
    }

    /// <summary>An event is brought in or taken back: an instant before which the world stands may be another now, and one of which a part has happened begins anew if the event can change it.</summary>
    private void BeginAnewFor(SimTime time)
    {
        if (time <= standsBefore)
        {
            Standing = null;
            standsBefore = SimTime.MaxValue;
        }

        if (IsWithinInstant && time <= SimTime.Max(within, KnownTo) && !Has(HealingFault.LeavesPartOfAnInstant))
        {
            TakeBackInstant(within); // or it would be changed in its middle
        }
    }
}
