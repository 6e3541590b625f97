using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>A heal that comes to where everybody is on the path he was on before is done: what is simulated of the future from there is right.</content>
public sealed partial class Simulation
{
    private readonly CutPaths cutPaths = new();
    private readonly HeldBackImpacts heldBack = new();

    /// <summary>Nothing will be put back of what the heal at hand cuts.</summary>
    private void GoOnToTheEnd()
    {
        cutPaths.GiveUp();
        heldBack.Release(SimTime.MaxValue);
    }

    /// <summary>Ends the heal at hand if at an instant, of which it has done all, the new paths have met the old, and if it may get so far at all.</summary>
    private bool HasMet(SimTime at, SimTime until)
    {
        if (!rollback.IsActive || at >= rollback.Horizon || at < rollback.Cursor.Time || until < rollback.Horizon)
        {
            return false; // no heal, or none any more; or of the instant of the news nothing is done; or whoever advances does not want that much yet
        }

        if (!cutPaths.IsWhole)
        {
            GoOnToTheEnd();
            return false;
        }

        if (!cutPaths.AreMet(timelines, at, Fault))
        {
            return false;
        }

        PutBack(at);
        return true;
    }

    private void PutBack(SimTime at)
    {
        SimTime met = rollback.Cursor.Time;
        SimTime to = rollback.Horizon;
        SimTime next = to + SimDuration.OneTick;
        for (int n = 0; n < cutPaths.BodyCount; n++)
        {
            int slot = cutPaths.SlotAt(n);
            log.SetDueFrom(slot, EventKey.Before(next));
        }

        timelines.Openings = null;
        cutPaths.PutBack(timelines, at, slot => bodies.Id(slot));
        for (int n = 0; n < cutPaths.BodyCount; n++)
        {
            ListAgain(cutPaths.SlotAt(n), at, next);
        }

        SimulatedTo = to;
        rollback.Horizon = SimTime.MinValue; // nobody is ahead of anybody
        rollback.Cursor = EventKey.Before(next);
        for (int n = 0; n < cutPaths.BodyCount; n++)
        {
            Predict(cutPaths.SlotAt(n));
        }

        while (scheduler.Count > 0 && scheduler.LeastKey.Time <= to)
        {
            Predict(scheduler.LeastSlot); // its next was to be with a path that did not last
        }

        heldBack.Release(at);
        EndHeal(met);
    }

    /// <summary>The index learns again of the paths from an instant on.</summary>
    private void ListAgain(int slot, SimTime from, SimTime until)
    {
        int piece = timelines.Last(slot);
        while (timelines.Key(piece).Time > from)
        {
            piece = timelines.Previous(piece);
        }

        for (; piece != TimelineStore.None; piece = timelines.Next(piece))
        {
            int next = timelines.Next(piece);
            if (timelines.Segment(piece).IsPresent)
            {
                index.Add(
                    slot, bodies.Spec(slot).Radius, piece, SimTime.Max(from, timelines.Key(piece).Time),
                    next == TimelineStore.None ? until : timelines.Key(next).Time);
            }
        }
    }
}
