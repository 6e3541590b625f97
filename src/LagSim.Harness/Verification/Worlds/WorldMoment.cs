using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>What is read of a world at an instant, after all events of that tick.</summary>
internal sealed class WorldMoment
{
    private const double Nothing = 1e-9; // metres: what is as deep as that is not deep

    /// <param name="simulation">The world, simulated to that instant.</param>
    /// <param name="acts">What players did at that tick.</param>
    internal WorldMoment(Simulation simulation, IReadOnlyList<ExternalEvent> acts)
    {
        Simulation = simulation;
        Acts = acts;
        List<WorldBody> bodies = [];
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyId body = simulation.BodyAt(n);
            if (simulation.TryRead(body, simulation.SimulatedTo, out BodyState state))
            {
                bodies.Add(new WorldBody(body, simulation.SpecOf(body), state));
            }
        }

        Bodies = bodies;
        Depths = [.. PairDepths().Concat(SurfaceDepths())];
    }

    internal Simulation Simulation { get; }

    internal Scene Scene => Simulation.Scene;

    internal SimTime Time => Simulation.SimulatedTo;

    /// <summary>The time since the start, in seconds.</summary>
    internal double Seconds => (Time - Simulation.Start).ToSeconds();

    internal IReadOnlyList<ExternalEvent> Acts { get; }

    /// <summary>The bodies that are there, in canonical order.</summary>
    internal IReadOnlyList<WorldBody> Bodies { get; }

    /// <summary>What is inside of what it collides with, and how deep, in metres.</summary>
    internal IReadOnlyList<WorldDepth> Depths { get; }

    internal bool HasHands => Bodies.Any(b => b.State.Motion == MotionLaw.Held);

    /// <summary>The way from one place to another, the shortest one in a periodic box.</summary>
    internal Vector3D Way(in Vector3D from, in Vector3D to)
    {
        Vector3D way = to - from;
        if (!Scene.Box.Exists)
        {
            return way;
        }

        Vector3D size = Scene.Box.Size;
        return way - new Vector3D(size.X * Math.Round(way.X / size.X), size.Y * Math.Round(way.Y / size.Y),
            size.Z * Math.Round(way.Z / size.Z));
    }

    private IEnumerable<WorldDepth> PairDepths()
    {
        for (int i = 0; i < Bodies.Count; i++)
        {
            for (int j = i + 1; j < Bodies.Count; j++)
            {
                WorldBody a = Bodies[i], b = Bodies[j];
                double depth = a.Spec.Radius + b.Spec.Radius - Way(a.State.Position, b.State.Position).Length;
                if (depth > Nothing && a.State.Filter.CollidesWith(b.State.Filter))
                {
                    yield return new WorldDepth(a, b, "", depth);
                }
            }
        }
    }

    private IEnumerable<WorldDepth> SurfaceDepths()
    {
        foreach (WorldBody body in Bodies)
        {
            foreach (StaticPlane plane in Scene.Planes)
            {
                double depth = -plane.Gap(body.State.Position, body.Spec.Radius);
                if (depth > Nothing && body.State.Filter.CollidesWith(plane.Filter))
                {
                    yield return new WorldDepth(body, null, plane.Name, depth);
                }
            }

            foreach (StaticSphere sphere in Scene.StaticSpheres)
            {
                double depth = sphere.Radius + body.Spec.Radius - (body.State.Position - sphere.Centre).Length;
                if (depth > Nothing && body.State.Filter.CollidesWith(sphere.Filter))
                {
                    yield return new WorldDepth(body, null, sphere.Name, depth);
                }
            }
        }
    }
}
