using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// Two bodies in flight, or one and a surface, that meet alone, and touch nothing else, part at the lesser restitution times the speed at which they closed, and two
/// keep their momentum.
/// </summary>
internal sealed class ReboundPromise : WorldPromise
{
    private const int MaxImpacts = 40; // reading what was before costs the events since
    private const double Relative = 1e-6; // for a parabola
    private const double OfSteps = 1e-5; // where the velocity read right before is that of a polynomial through steps
    private const double Slow = 1e-6; // m/s: slower closing may count as rounding

    private readonly Func<BodySpec, double> restitutionOf;

    internal ReboundPromise()
        : this(static spec => spec.Restitution)
    {
    }

    /// <param name="restitutionOf">The restitution of a body; a test expects another.</param>
    internal ReboundPromise(Func<BodySpec, double> restitutionOf) => this.restitutionOf = restitutionOf;

    internal override string Name => "rebound";

    internal override void Finish(WorldMoment end, IReadOnlyCollection<SimTime> ticksOfActs)
    {
        Simulation world = end.Simulation;
        Dictionary<SimTime, List<(BodyId Body, TimelineEntry Entry)>> ticks = [];
        for (int n = 0; n < world.BodyCount; n++)
        {
            BodyId body = world.BodyAt(n);
            foreach (TimelineEntry entry in world.Timeline(body))
            {
                if (!ticks.TryGetValue(entry.Key.Time, out List<(BodyId, TimelineEntry)>? at))
                {
                    ticks[entry.Key.Time] = at = [];
                }

                at.Add((body, entry));
            }
        }

        int left = MaxImpacts;
        foreach ((SimTime tick, List<(BodyId Body, TimelineEntry Entry)> at) in ticks.OrderByDescending(t => t.Key))
        {
            EventKey key = at[0].Entry.Key;
            bool isAlone = key.Kind == EventKind.Impact && key.Round == 0 && at.All(e => e.Entry.Key == key)
                && at.Count == (key.Other == key.Body ? 1 : 2) && !ticksOfActs.Contains(tick) && tick > world.Start;
            if (isAlone && at.All(e => IsFree(e.Entry.State.Motion)) && left-- > 0)
            {
                Check(end, tick, at);
            }
        }
    }

    private static bool IsFree(MotionLaw motion) =>
        motion is MotionLaw.Ballistic or MotionLaw.ClosedForm or MotionLaw.DormandPrince54 or MotionLaw.RungeKutta4;

    private void Check(WorldMoment end, SimTime tick, List<(BodyId Body, TimelineEntry Entry)> at)
    {
        Simulation world = end.Simulation;
        BodyState[] before = [.. at.Select(e => world.TryRead(e.Body, tick - SimDuration.OneTick, out BodyState state) ? state : default)];
        if (!before.All(s => IsFree(s.Motion)))
        {
            return;
        }

        double relative = before.All(s => s.Motion == MotionLaw.Ballistic) ? Relative : OfSteps;
        BodySpec spec = world.SpecOf(at[0].Body);
        BodyState first = at[0].Entry.State;
        double closing, opening, restitution, speed = before.Concat(at.Select(e => e.Entry.State)).Max(s => s.Velocity.Length);
        if (at.Count == 2)
        {
            BodySpec other = world.SpecOf(at[1].Body);
            if (TouchesSurface(world.Scene, first, spec) || TouchesSurface(world.Scene, at[1].Entry.State, other))
            {
                return; // a surface gives some of it
            }

            BodyState second = at[1].Entry.State;
            Vector3D way = end.Way(first.Position, second.Position), normal = way * (1 / way.Length);
            closing = Vector3D.Dot(normal, before[0].Velocity - before[1].Velocity);
            opening = Vector3D.Dot(normal, second.Velocity - first.Velocity);
            restitution = Math.Min(restitutionOf(spec), restitutionOf(other));
            Vector3D gained = ((first.Velocity - before[0].Velocity) * spec.Mass) + ((second.Velocity - before[1].Velocity) * other.Mass);
            if (!(gained.Length <= 1e-8 * speed * (spec.Mass + other.Mass)))
            {
                Break(end, string.Create(Invariant,
                    $"{at[0].Body} and {at[1].Body}, which met at {(tick - world.Start).ToSeconds():0.######} s, gained {gained} N s."));
            }
        }
        else if (Surface(world.Scene, first, spec) is (Vector3D normal, double ofSurface))
        {
            closing = -Vector3D.Dot(normal, before[0].Velocity);
            opening = Vector3D.Dot(normal, first.Velocity);
            restitution = Math.Min(restitutionOf(spec), ofSurface);
        }
        else
        {
            return; // two surfaces at once
        }

        if (closing > Slow && !(Math.Abs(opening - (restitution * closing)) <= (relative * speed) + 1e-8))
        {
            Break(end, string.Create(Invariant,
                $"{string.Join(" and ", at.Select(e => e.Body))} closed at {closing:G9} m/s at {(tick - world.Start).ToSeconds():0.######} s and"
                + $" parted at {opening:G9} m/s, with a restitution of {restitution:G4}."));
        }
    }

    /// <summary>The one surface that a body touches; null if there are two, or none.</summary>
    private static (Vector3D Normal, double Restitution)? Surface(Scene scene, in BodyState state, in BodySpec spec)
    {
        List<(Vector3D Normal, double Restitution)> all = Surfaces(scene, state, spec);
        return all.Count == 1 ? all[0] : null;
    }

    private static bool TouchesSurface(Scene scene, in BodyState state, in BodySpec spec) => Surfaces(scene, state, spec).Count > 0;

    private static List<(Vector3D Normal, double Restitution)> Surfaces(Scene scene, in BodyState state, in BodySpec spec)
    {
        List<(Vector3D, double)> near = [];
        foreach (StaticPlane plane in scene.Planes)
        {
            if (Math.Abs(plane.Gap(state.Position, spec.Radius)) < 1e-6 && state.Filter.CollidesWith(plane.Filter))
            {
                near.Add((plane.Normal, plane.Restitution));
            }
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            Vector3D from = state.Position - sphere.Centre;
            if (Math.Abs(from.Length - sphere.Radius - spec.Radius) < 1e-6 && state.Filter.CollidesWith(sphere.Filter))
            {
                near.Add((from * (1 / from.Length), sphere.Restitution));
            }
        }

        return near;
    }
}
