using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>A rewinder that cuts at times instead of keys, applies no event again, or leaves something that it should have cut.</summary>
internal sealed class FaultyRewinder(
    BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
    Reconvergence reconvergence, EventPredictor predictor, HealingMode mode, FaultyEngineParts faults)
    : Rewinder(bodies, timelines, log, scheduler, progress, rollback, reconvergence, predictor, mode)
{
    private readonly TimelineStore timelines = timelines;
    private readonly Progress progress = progress;
    private readonly RollbackState rollback = rollback;
    private bool isCutByTime;

    internal override void Mark(int slot, in EventKey key)
    {
        if (!faults.Has(HealingFault.LeavesWhoRests) || timelines.Segment(timelines.Last(slot)).Law != MotionLaw.Resting)
        {
            base.Mark(slot, key);
        }
    }

    internal override void RewindInstant(SimTime instant)
    {
        if (!faults.Has(HealingFault.LeavesPartOfAnInstant))
        {
            base.RewindInstant(instant);
        }
    }

    private protected override void RewindPlacings(in EventKey after, SimTime last)
    {
        if (!faults.Has(HealingFault.LeavesPlacings))
        {
            base.RewindPlacings(after, last);
        }
    }

    private protected override void CutWhatWakes(int body, in EventKey from)
    {
        if (!faults.Has(HealingFault.LeavesWhatWakes))
        {
            base.CutWhatWakes(body, from);
        }
    }

    private protected override void CutStruckWith(int body, in EventKey from)
    {
        if (!faults.Has(HealingFault.LeavesStruckAgain))
        {
            base.CutStruckWith(body, from);
        }
    }

    private protected override EventKey CutsFrom(in EventKey key)
    {
        isCutByTime = faults.Has(HealingFault.CutsByTime) && key == rollback.Cursor && key.Time > progress.HistoryEdge;
        return isCutByTime ? EventKey.Before(key.Time) : base.CutsFrom(key);
    }

    private protected override EventKey CutsAllFrom(in EventKey key) =>
        faults.CutsByTime ? new EventKey(key.Time, 0, EventKind.Spawn, default, default, 0, 0) : base.CutsAllFrom(key);

    private protected override void Redo(int slot, in EventKey from)
    {
        if (!faults.Has(HealingFault.DropsEvents) && !isCutByTime)
        {
            base.Redo(slot, from);
        }
    }

    private protected override void CutCrossings(CrossingLog crossings, int slot, in EventKey from)
    {
        if (!faults.Has(HealingFault.LeavesCrossings) || from.Kind == EventKind.Crossing) // else a carrier would ask for ever
        {
            base.CutCrossings(crossings, slot, from);
        }
    }

    private protected override void NoteDependents(SensorDependencies sensors, int slot, in EventKey from)
    {
        if (!faults.Has(HealingFault.LeavesCarried))
        {
            base.NoteDependents(sensors, slot, from);
        }
    }
}
