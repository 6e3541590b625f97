using System;
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
    private CutCrossings? crossings;

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

    /// <summary>The observer of crossings made and cut; null, the default, for none.</summary>
    internal ICrossingObserver? CrossingObserver
    {
        get => heldBack.CrossingListener;
        set
        {
            heldBack.CrossingListener = value;
            if (crossings is not null)
            {
                crossings.Log.Observer = value is null ? null : heldBack;
            }
        }
    }

    /// <summary>From now on crossings of sensors, too, are kept when they are cut, and put back.</summary>
    internal void Keep(CutCrossings ofCrossings) => crossings = ofCrossings;

    /// <summary>A rollback begins: from now on what it cuts is kept.</summary>
    internal void Begin()
    {
        cut.Begin(timelines.LastSerial);
        crossings?.Begin();
        heldBack.Hold();
    }

    /// <summary>The rollback touches a body that it had not touched.</summary>
    internal void Touch(int slot) => cut.Touch(slot);

    /// <summary>Of a body that was touched the newest segment is about to be cut.</summary>
    internal void Keep(int slot, int segment) => cut.Keep(timelines, slot, segment);

    /// <summary>Of a body that was touched the crossings from a key on are about to be cut.</summary>
    internal void KeepCrossings(int slot, in EventKey from) => crossings?.Keep(slot, from);

    /// <summary>Nothing that the current rollback cuts will be put back.</summary>
    internal void GiveUp()
    {
        cut.GiveUp();
        crossings?.GiveUp();
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
        if (mayBe && !(cut.IsWhole && crossings?.IsWhole != false))
        {
            GiveUp();
            return false;
        }

        return mayBe && cut.HaveReconverged(timelines, at) && HaveCrossedTheSame(at) && (Rules is null || Rules.HaveReconverged());
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
        crossings?.PutBack(at);
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
            int slot = scheduler.MinSlot;
            EventKey stale = scheduler.MinKey;
            predictor.Predict(slot); // its next was to be with a path that did not last
            if (scheduler.TryGet(slot, out EventKey found) && found == stale)
            {
                throw new InvalidOperationException($"A heal has left out {stale}, which lies before where it ended.");
            }
        }

        heldBack.Release(at);
    }

    /// <summary>Whether each body that was touched is inside of the same sensors as before, and crossed the same on its segment.</summary>
    private bool HaveCrossedTheSame(SimTime at)
    {
        if (crossings is null || crossings.AreUntouched)
        {
            return true;
        }

        bool areSame = true;
        for (int n = 0; n < cut.BodyCount && areSame; n++)
        {
            areSame = crossings.AreTheSame(cut.SlotAt(n), timelines.Key(timelines.Last(cut.SlotAt(n))), at);
        }

        return areSame;
    }
}
