using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>A world that stops within an instant, or stands before one without end, and waits for an event that takes away what makes it so dear.</content>
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
        TakeBackAll(EventKey.Before(instant));
    }

    /// <summary>An event is brought in or taken back: what it lies before may be another instant now, and one of which a part has happened begins anew.</summary>
    private void BeginAnewFor(SimTime time)
    {
        if (time <= standsBefore)
        {
            Standing = null;
            standsBefore = SimTime.MaxValue;
        }

        if (within != SimTime.MinValue && !Has(HealingFault.LeavesPartOfAnInstant))
        {
            TakeBackInstant(within); // or it would be changed in its middle
        }
    }
}
