using LagSim.Events;
using LagSim.Time;

namespace LagSim;

/// <content>Full rollback: simple, correct, and the measure for everything cleverer.</content>
public sealed partial class Simulation
{
    /// <summary>Cuts timelines at their time instead of at their key, which is wrong: only a test's negative control sets it.</summary>
    internal bool CutsByTime { get; set; }

    /// <summary>
    /// Whether a late event has only its own instant simulated again, so that <see cref="SimulatedTo"/> goes back, and not even that where an earlier one has
    /// taken it further back already; whoever advances does the rest, in pieces if need be, and for several late events once.
    /// </summary>
    internal bool DefersAgain { get; set; }

    /// <summary>Cuts every timeline at the key, not at its time, and simulates again up to where the world was.</summary>
    private void RollBack(in EventKey key)
    {
        SimTime to = SimulatedTo;
        SimulatedTo = key.Time - SimDuration.OneTick;
        TakeBackAll(key);
        AdvanceAsFarAs(DefersAgain ? key.Time : to);
    }

    /// <summary>Cuts every timeline at the key, and has everybody predicted again.</summary>
    private void TakeBackAll(in EventKey key)
    {
        rollback.Cursor = key;
        rollback.LastOld = -1; // nobody is ahead of anybody
        EventKey cut = CutsByTime ? new EventKey(key.Time, 0, EventKind.Spawn, default, default, 0, 0) : key;
        for (int slot = 0; slot < bodies.SlotCount; slot++)
        {
            SegmentsCut += timelines.CutFrom(slot, bodies.Id(slot), cut);
            log.SetDueFrom(slot, key);
            scheduler.Remove(slot);
        }

        for (int slot = 0; slot < bodies.SlotCount; slot++)
        {
            CountHealed(slot);
            Predict(slot);
        }
    }
}
