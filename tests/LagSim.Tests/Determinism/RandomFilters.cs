using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>Draws collision filters and tags into a scene and events that were drawn without.</summary>
internal static class RandomFilters
{
    /// <summary>The scene with a filter on some of its parts.</summary>
    internal static Scene On(Scene scene, Random from)
    {
        SceneBuilder builder = new SceneBuilder(scene.Name).WithGravity(scene.Gravity).WithSmallestRadius(scene.SmallestRadius);
        foreach (Force force in scene.Forces)
        {
            builder.AddForce(force);
        }

        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution, plane.Friction, from.Next(3) == 0 ? Draw(from) : default);
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            builder.AddStaticSphere(sphere.Name, sphere.Centre, sphere.Radius, sphere.Restitution, sphere.Friction, from.Next(2) == 0 ? Draw(from) : default);
        }

        foreach (SceneBody body in scene.Bodies)
        {
            builder.AddBody(body.Name, Drawn(body.Spec, from), body.Position, body.Velocity, body.Players, body.Spin);
        }

        foreach (Sensor sensor in scene.Sensors)
        {
            builder.AddSensor(from.Next(2) == 0 ? sensor.With(Draw(from)) : sensor, scene);
        }

        return builder.Build();
    }

    /// <summary>Gives spawned bodies filters, and has some of all bodies change theirs, at busy instants and beside them.</summary>
    internal static void AddTo(List<ExternalEvent> events, Random from)
    {
        for (int i = 0; i < events.Count; i++)
        {
            ExternalEvent e = events[i];
            events[i] = e.Kind == EventKind.Spawn
                ? ExternalEvent.Spawn(e.Time, e.Peer, e.Sequence, Drawn(e.Spec, from), e.Position, e.Velocity, e.Spin, e.Players, e.WhenOccupied) : e;
        }

        List<BodyId> known = [.. events.Select(e => e.Body), BodyId.OfScene(0), BodyId.OfScene(1)];
        SimTime[] times = [At(0), At(0.25), At(0.5), .. events.Select(e => e.Time)];
        int changes = from.Next(1, 8);
        for (int i = 0; i < changes; i++)
        {
            SimTime time = times[from.Next(times.Length)] + SimDuration.FromTicks(from.Next(3));
            SimTime later = from.Next(3) == 0 ? time + SimDuration.FromSeconds(from.NextDouble() * 0.4) : time;
            events.Add(ExternalEvent.SetFilter(later > At(RandomWorld.End) ? time : later, (byte)from.Next(0, 4), 5000u + (uint)i, known[from.Next(known.Count)], Draw(from)));
        }

        // Into walls, which stop a body or do not by the filter that it has then.
        for (uint i = 0; i < 2; i++)
        {
            SimTime time = times[from.Next(times.Length)];
            Vector3D place = V(-3 + (from.Next(5) * 1.5), -1 + from.Next(3), from.Next(2));
            events.Add(ExternalEvent.Teleport(time, (byte)from.Next(0, 4), 6000u + i, known[from.Next(known.Count)], place, default, (WhenOccupied)from.Next(3)));
        }
    }

    private static BodySpec Drawn(in BodySpec spec, Random from) =>
        (from.Next(2) == 0 ? spec.With(Draw(from)) : spec).WithTag((ulong)from.NextInt64());

    private static CollisionFilter Draw(Random from) => from.Next(5) switch
    {
        0 => default,
        1 => new CollisionFilter(2),
        2 => new CollisionFilter(1, 1),
        3 => new CollisionFilter(3, 2),
        _ => new CollisionFilter(2, 1),
    };
}
