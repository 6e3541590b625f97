using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>What a call of rules does to bodies, in the round after it; and whether it may still do something at its tick.</summary>
internal sealed class RuleDeeds(Scene scene)
{
    private readonly List<RuleAct> acts = new();
    private EventKey key;
    private RuleTally before;

    /// <summary>What the call did.</summary>
    internal List<RuleAct> All => acts;

    /// <summary>Whether it caused something at its own tick.</summary>
    internal bool Chains { get; private set; }

    /// <summary>How much of what it wanted to do at its own tick had no effect.</summary>
    internal int Dropped { get; private set; }

    /// <summary>Whether rules have done in this tick what they may.</summary>
    internal bool IsOver => acts.Count >= before.ActsLeft;

    /// <summary>A call begins.</summary>
    internal void Begin(RuleCall call)
    {
        key = call.Key;
        before = call.Before;
        Clear();
    }

    /// <summary>What it did counts as not done.</summary>
    internal void Clear()
    {
        acts.Clear();
        Chains = false;
        Dropped = 0;
    }

    /// <summary>It does something to a body, if it may.</summary>
    internal void Add(in ExternalEvent what)
    {
        if (acts.Count == RuleWorld.MaxActs)
        {
            throw new RuleException($"A call did {RuleWorld.MaxActs} things to bodies; it may do no more.");
        }

        ExternalEventCheck.ThrowIfUnfit(what, scene);
        if (MayCause())
        {
            uint number = checked(before.First + (uint)acts.Count + 1);
            acts.Add(new RuleAct(new EventKey(key.Time, checked(key.Round + 1), what.Kind, what.Body, what.Body, SceneRules.Peer, number), what));
        }
    }

    /// <summary>It wants to cause something at its own tick; false if it may not.</summary>
    internal bool MayCause()
    {
        bool mayCause = !IsOver;
        Dropped += mayCause ? 0 : 1;
        Chains |= mayCause;
        return mayCause;
    }

    /// <summary>Something that it would do at its own tick has no effect.</summary>
    internal void Drop() => Dropped++;

    /// <summary>Whether a body would be inside of none that the call has spawned.</summary>
    internal bool IsApartFromSpawned(in BodySpec spec, in Vector3D position)
    {
        bool isApart = true;
        for (int n = 0; n < acts.Count && isApart; n++)
        {
            ExternalEvent act = acts[n].What;
            isApart = act.Kind != EventKind.Spawn || !spec.Filter.CollidesWith(act.Spec.Filter)
                || scene.Box.Nearest(position - act.Position).Length >= spec.Radius + act.Spec.Radius;
        }

        return isApart;
    }
}
