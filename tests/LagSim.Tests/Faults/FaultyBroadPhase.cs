using System;
using LagSim.BroadPhase;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>A broad phase that can leave one body out of its answers, and whose lists may forget who has moved on ahead of a heal.</summary>
internal sealed class FaultyBroadPhase(
    Scene scene, BodyTable bodies, TimelineStore timelines, int bruteForceLimit, FaultyEngineParts faults)
    : AdaptiveBroadPhase(scene, bodies, timelines, bruteForceLimit)
{
    private readonly Scene scene = scene;
    private readonly BodyTable bodies = bodies;
    private readonly TimelineStore timelines = timelines;
    private int[] left = new int[16];

    /// <summary>The slot of the body that is no candidate; <see cref="PendingContact.NoPartner"/> for nobody.</summary>
    internal int LeftOut { get; set; } = PendingContact.NoPartner;

    private FaultyEngineParts Faults => faults;

    private protected override BruteForce MakeBruteForce() => new Pairs(this);

    private protected override NeighbourLists MakeLists(double cell, double speed, double tickLength) =>
        new Lists(this, cell, speed, scene.RestitutionThreshold, tickLength, scene.Box);

    private Span<int> Without(Span<int> candidates)
    {
        int at = candidates.IndexOf(LeftOut);
        if (at < 0)
        {
            return candidates;
        }

        left = left.Length < candidates.Length ? new int[candidates.Length * 2] : left;
        candidates[..at].CopyTo(left);
        candidates[(at + 1)..].CopyTo(left.AsSpan(at));
        return left.AsSpan(0, candidates.Length - 1);
    }

    private sealed class Pairs(FaultyBroadPhase owner) : BruteForce, IBroadPhase
    {
        Span<int> IBroadPhase.Candidates(int slot, double radius, SimTime from, long heal, out SimTime until) =>
            owner.Without(Candidates(slot, radius, from, heal, out until));
    }

    private sealed class Lists(FaultyBroadPhase owner, double cell, double speed, double near, double tickLength, in PeriodicBox box)
        : NeighbourLists(owner.timelines, cell, speed, near, tickLength, box, owner.bodies.SlotCount), IBroadPhase
    {
        Span<int> IBroadPhase.Candidates(int slot, double radius, SimTime from, long heal, out SimTime until) =>
            owner.Without(Candidates(slot, radius, from, heal, out until));

        private protected override bool KeepsListsOfOneHeal => !owner.Faults.Has(HealingFault.ForgetsBodiesMovedOn);
    }
}
