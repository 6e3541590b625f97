using System.Collections.Generic;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Rules;
using LagSim.Timelines;

namespace LagSim;

/// <summary>What rules do to bodies: events of the bodies' logs, which a call that is made again exchanges.</summary>
internal sealed class RuleActs(
    BodyRoster roster, BodyTable bodies, EventLog log, BroadPhaseGrowth growth, EventPredictor predictor, Rewinder rewinder)
{
    private readonly List<(int Slot, EventKey Key)> changed = new();

    /// <summary>Takes back what a call did.</summary>
    internal void TakeBack(RuleCall call)
    {
        foreach (RuleAct act in call.Acts)
        {
            Remove(act);
        }

        call.Acts.Clear();
    }

    /// <summary>A call does this now, and no more what it did before. What is the same stays.</summary>
    internal void Exchange(RuleCall call, List<RuleAct> acts)
    {
        foreach (RuleAct old in call.Acts)
        {
            if (!Contains(acts, old))
            {
                Remove(old);
            }
        }

        foreach (RuleAct act in acts)
        {
            if (!Contains(call.Acts, act))
            {
                Add(act);
            }
        }

        call.Acts.Clear();
        call.Acts.AddRange(acts);
    }

    /// <summary>Has the bodies whose events have changed go on with that; those that are known beyond are rewound.</summary>
    internal void Follow()
    {
        growth.Fit();
        for (int n = 0; n < changed.Count; n++)
        {
            (int slot, EventKey key) = changed[n];
            if (rewinder.IsKnown(key))
            {
                rewinder.Rewind(slot, key);
            }
            else
            {
                log.AddDueFrom(slot, key);
                predictor.Predict(slot);
            }
        }

        changed.Clear();
    }

    private static bool Contains(List<RuleAct> acts, in RuleAct act)
    {
        foreach (RuleAct one in acts)
        {
            if (one.IsSameAs(act))
            {
                return true;
            }
        }

        return false;
    }

    private void Add(in RuleAct act)
    {
        int slot = bodies.SlotOf(act.What.Body);
        if (slot < 0)
        {
            slot = roster.AddAbsent(act.What.Body);
        }

        log.TryAdd(slot, act.What, act.Key, forwarded: false);
        changed.Add((slot, act.Key));
    }

    private void Remove(in RuleAct act)
    {
        int slot = bodies.SlotOf(act.What.Body);
        log.Remove(slot, act.Key);
        changed.Add((slot, act.Key));
    }
}
