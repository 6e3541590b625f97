using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Rules;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Adds external events to the world, and retracts them. Paths that are known beyond such an event are rewound.</summary>
internal sealed class EventIntake(
    BodyRoster roster, BodyTable bodies, EventLog log, Progress progress, BroadPhaseGrowth growth, EventPredictor predictor,
    Rewinder rewinder, EventLoop loop, RuleLog? rules)
{
    /// <summary>Adds an external event at a key, and marks what it changes of what is known already.</summary>
    internal SubmitResult Insert(in ExternalEvent external, in EventKey key, bool isForwarded)
    {
        if (key.Time < progress.HistoryEdge)
        {
            return SubmitResult.TooOld;
        }

        if (EventKinds.IsForRules(external.Kind))
        {
            return InsertTold(external, key);
        }

        int slot = bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            slot = roster.AddAbsent(external.Body);
            growth.Fit();
        }

        log.DropBefore(slot, progress.HistoryEdge);
        if (!log.TryAdd(slot, external, key, isForwarded))
        {
            return SubmitResult.Duplicate;
        }

        loop.Reconsider(key.Time);
        if (rewinder.IsKnown(key))
        {
            rewinder.Mark(slot, key);
            return SubmitResult.RolledBack;
        }

        int next = log.Due(slot);
        if (next == EventLog.None || EventKey.Compare(key, log.Key(next)) < 0)
        {
            log.SetDueFrom(slot, key);
            predictor.Predict(slot);
        }

        return SubmitResult.Queued;
    }

    /// <summary>Retracts an external event; false if it is not there (any more).</summary>
    internal bool Retract(in ExternalEvent external)
    {
        if (EventKinds.IsForRules(external.Kind))
        {
            return RetractTold(external);
        }

        int slot = bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            return false;
        }

        log.DropBefore(slot, progress.HistoryEdge); // what is older can no longer be changed
        int next = log.Due(slot);
        EventKey due = next == EventLog.None ? EventKey.Before(progress.Start) : log.Key(next);
        if (!log.TryRemove(slot, external, out EventKey key))
        {
            return false;
        }

        loop.Reconsider(key.Time);
        if (key == due && log.Due(slot) == next) // otherwise an earlier one is due again
        {
            log.SetDueFrom(slot, key);
        }

        if (rewinder.IsKnown(key))
        {
            rewinder.Mark(slot, key);
        }
        else if (key == due)
        {
            predictor.Predict(slot);
        }

        return true;
    }

    private SubmitResult InsertTold(in ExternalEvent external, in EventKey key)
    {
        if (rules!.Has(key))
        {
            return SubmitResult.Duplicate;
        }

        loop.Reconsider(key.Time);
        bool isKnown = rewinder.IsKnown(key);
        if (isKnown)
        {
            rewinder.MarkRules(key);
        }

        rules.Add(key, new RuleTrigger(external));
        return isKnown ? SubmitResult.RolledBack : SubmitResult.Queued;
    }

    private bool RetractTold(in ExternalEvent external)
    {
        if (!rules!.TryFindTold(external.Key.Origin, out EventKey key) || key.Time < progress.HistoryEdge)
        {
            return false;
        }

        loop.Reconsider(key.Time);
        if (rewinder.IsKnown(key))
        {
            rewinder.MarkRules(key);
        }

        rules.Retract(key);
        return true;
    }
}
