using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// Tells whether every re-simulated path is again the one that it replaced, and then puts back what was cut from there on: everything after
/// that instant would happen as it did before.
/// </summary>
internal sealed class Reconvergence(
    BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
    AdaptiveBroadPhase broadPhase, EventPredictor predictor, CutPaths cut)
{
    private readonly HeldBackImpacts heldBack = new();

    /// <summary>The calls of rules; null, the default, where there are none.</summary>
    internal RuleLog? Rules { get; set; }

    /// <summary>The observer of impacts made and cut; null, the default, for none.</summary>
    internal IImpactObserver? Observer
    {
        get => heldBack.Listener;
        set
        {
            heldBack.Listener = value;
            timelines.Observer = value is null ? null : heldBack;
        }
    }

    /// <summary>A rollback begins: from now on what it cuts is kept.</summary>
    internal void Begin()
    {
        cut.Begin(timelines.LastSerial);
        heldBack.Hold();
    }

    /// <summary>The rollback touches a body that it had not touched.</summary>
    internal void Touch(int slot) => cut.Touch(slot);

    /// <summary>Of a body that was touched the newest segment is about to be cut.</summary>
    internal void Keep(int slot, int segment) => cut.Keep(timelines, slot, segment);

    /// <summary>Nothing that the current rollback cuts will be put back.</summary>
    internal void GiveUp()
    {
        cut.GiveUp();
        heldBack.Release(SimTime.MaxValue);
    }

    /// <summary>
    /// Whether at an instant, of which the rollback has done all, each body that it has touched is on the path that it was on before.
    /// </summary>
    /// <param name="at">The instant.</param>
    /// <param name="until">How far the world is to be advanced: less than the rollback horizon means that it may not jump there
    /// yet.</param>
    internal bool IsReached(SimTime at, SimTime until)
    {
        bool mayBe = rollback.IsActive && at < rollback.Horizon && at >= rollback.Cursor.Time && until >= rollback.Horizon;
        if (mayBe && !cut.IsWhole)
        {
            GiveUp();
            return false;
        }

        return mayBe && cut.HaveReconverged(timelines, at) && (Rules is null || Rules.HaveReconverged());
    }

    /// <summary>
    /// Puts back what was cut after an instant at which it is reached: the world is simulated to the rollback horizon again.
    /// </summary>
    internal void PutBack(SimTime at)
    {
        SimTime to = rollback.Horizon;
        SimTime next = to + SimDuration.OneTick;
        for (int n = 0; n < cut.BodyCount; n++)
        {
            log.SetDueFrom(cut.SlotAt(n), EventKey.Before(next));
        }

        timelines.Openings = null;
        cut.PutBack(timelines, at, bodies);
        for (int n = 0; n < cut.BodyCount; n++)
        {
            broadPhase.List(cut.SlotAt(n), at, next);
        }

        Rules?.PutBack(to);
        progress.SimulatedTo = to;
        rollback.End(); // no body is ahead of another
        rollback.Cursor = EventKey.Before(next);
        for (int n = 0; n < cut.BodyCount; n++)
        {
            predictor.Predict(cut.SlotAt(n));
        }

        while (scheduler.Count > 0 && scheduler.MinKey.Time <= to)
        {
            predictor.Predict(scheduler.MinSlot); // its next was to be with a path that did not last
        }

        heldBack.Release(at);
    }
}
