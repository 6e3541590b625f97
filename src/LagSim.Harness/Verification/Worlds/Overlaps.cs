using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Knows whether bodies are in one another because players put them there, and how deep all others may be.</summary>
internal sealed class Overlaps
{
    /// <summary>How many contact tolerances what was not put there may be deep: what solvers leave of an island, and jams.</summary>
    internal const double Most = 4;

    private readonly HashSet<(BodyId, BodyId, string)> put = [];
    private readonly bool hasRules;

    internal Overlaps(WorldScene world) => hasRules = world.Scene.Rules is not null;

    /// <summary>
    /// Whether something is, or is pushed deep by what is pushed out. It lasts until nothing is deep any more.
    /// </summary>
    internal bool ArePutIn { get; private set; }

    /// <summary>Whether contact steps were taken so far.</summary>
    internal bool HasSteps { get; private set; }

    /// <summary>
    /// How deep two may be in each other: four tolerances, and on a round surface what a chord leaves of it, v² h² / 8R (docs/CONTACT.md).
    /// </summary>
    internal static double Bound(WorldMoment moment, WorldDepth depth)
    {
        double tolerance = moment.Scene.ContactTolerance, pull = Math.Max(1, moment.Scene.Gravity.Length);
        double step = Math.Min(1.0 / 64, Math.Sqrt(2 * tolerance / pull));
        double way = step * (depth.First.State.Velocity - (depth.Second?.State.Velocity ?? Vector3D.Zero)).Length;
        return (Most * tolerance) + (way * way / (8 * depth.First.Spec.Radius));
    }

    internal void Look(WorldMoment moment)
    {
        HasSteps |= moment.Simulation.Engine.Stepper.StepsTaken > 0 || moment.Bodies.Any(b => b.State.Motion == MotionLaw.Constrained);
        HashSet<BodyId> moved = [.. moment.Acts.Where(a => a.Kind is not (EventKind.SetVelocity or EventKind.Impulse)).Select(a => a.Body)];
        foreach (WorldDepth depth in moment.Depths)
        {
            // Rules act at any tick.
            if (depth.HasHand || hasRules || moved.Contains(depth.First.Id)
                || (depth.Second is WorldBody other && moved.Contains(other.Id)))
            {
                put.Add(depth.Pair);
            }
        }

        put.IntersectWith(moment.Depths.Where(d => d.Metres > moment.Scene.ContactTolerance).Select(d => d.Pair));
        ArePutIn = put.Count > 0 || moment.HasHands || (ArePutIn && moment.Depths.Any(d => d.Metres > Bound(moment, d)));
    }
}
