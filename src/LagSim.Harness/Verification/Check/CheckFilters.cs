using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>The collision filters and tags of a seeded session, how players change filters, and what becomes of bodies put where others are.</summary>
/// <remarks>Drawn from streams of their own, and in some sessions only, so that all others stay the same.</remarks>
internal sealed class CheckFilters
{
    private const double Percent = 15;
    private const double SurfacePercent = 25;
    private const double BodyPercent = 50;
    private const int FewestChanges = 4;
    private const int MaxChanges = 16;
    private const ulong SurfaceStream = 1;
    private const ulong FirstBody = 10;
    private const ulong FirstActions = 1000;

    private readonly SeededRandom random;

    /// <param name="random">The stream to draw from.</param>
    /// <param name="mayExist">Whether there may be any.</param>
    internal CheckFilters(SeededRandom random, bool mayExist)
    {
        this.random = random;
        Exist = mayExist && random.Fork(0).IsLucky(Percent);
    }

    /// <summary>Whether the session has any.</summary>
    internal bool Exist { get; }

    /// <summary>Returns a scene with filters on some of its surfaces and bodies, and tags on all bodies.</summary>
    /// <param name="scene">The scene without.</param>
    /// <param name="kept">The numbers that its bodies had when drawn.</param>
    internal Scene On(Scene scene, IReadOnlyList<int> kept)
    {
        if (!Exist)
        {
            return scene;
        }

        SeededRandom surfaces = random.Fork(SurfaceStream);
        SceneBuilder builder = new SceneBuilder(scene.Name).WithGravity(scene.Gravity).WithRestitutionThreshold(scene.RestitutionThreshold)
            .WithContactTolerance(scene.ContactTolerance).WithSmallestRadius(scene.SmallestRadius).WithSpawners(scene.Spawners);
        if (scene.Box.Exists)
        {
            builder.WithPeriodicBox(scene.Box.Size);
        }

        foreach (Force force in scene.Forces)
        {
            builder.AddForce(force);
        }

        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution, plane.Friction, DrawOften(surfaces, SurfacePercent));
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            builder.AddStaticSphere(
                sphere.Name, sphere.Centre, sphere.Radius, sphere.Restitution, sphere.Friction, DrawOften(surfaces, 2 * SurfacePercent));
        }

        for (int i = 0; i < kept.Count; i++)
        {
            SceneBody body = scene.Bodies[i];
            builder.AddBody(body.Name, OfBody(body.Spec, FirstBody + (ulong)kept[i]), body.Position, body.Velocity, body.Players, body.Spin);
        }

        foreach (Sensor sensor in scene.Sensors)
        {
            builder.AddSensor(sensor, scene);
        }

        return builder.Build();
    }

    /// <summary>Gives spawned bodies filters and tags, and adds actions that change filters, often of bodies that something else is done to.</summary>
    internal void AddTo(List<CheckAction> actions, CheckScene room, int players, ulong attempt)
    {
        if (!Exist)
        {
            return;
        }

        SeededRandom from = random.Fork(FirstActions + attempt);
        for (int i = 0; i < actions.Count; i++)
        {
            WhenOccupied occupied = from.Pick(WhenOccupied.Overlap, WhenOccupied.Skip, WhenOccupied.Beside, WhenOccupied.Beside);
            actions[i] = actions[i].Kind switch
            {
                EventKind.Spawn => actions[i] with { Spec = OfBody(actions[i].Spec, (FirstActions * (attempt + 2)) + (ulong)i), WhenOccupied = occupied },
                EventKind.Teleport => actions[i] with { WhenOccupied = occupied },
                _ => actions[i],
            };
        }

        List<CheckAction> all = [.. actions];
        int changes = FewestChanges + from.NextInt(MaxChanges - FewestChanges + 1);
        for (int i = 0; i < changes; i++)
        {
            CheckAction near = from.Pick([.. actions]);
            bool isOfSame = from.IsLucky(60) && near.Kind != EventKind.Spawn;
            double at = from.IsLucky(40) ? near.AtSeconds : from.NextDouble() * room.BusySeconds;
            bool isThere = isOfSame && (near.Spawn < 0 || actions[near.Spawn].AtSeconds <= at);
            all.Add(new CheckAction(
                at, from.NextInt(players), EventKind.SetFilter, isThere ? near.Body : room.DrawBody(from), isThere ? near.Spawn : -1, default, default,
                default, Filter: Draw(from)));
        }

        CheckHands.PutInOrder(actions, all);
    }

    private BodySpec OfBody(in BodySpec spec, ulong stream)
    {
        SeededRandom from = random.Fork(stream);
        return spec.With(DrawOften(from, BodyPercent)).WithTag((ulong)(from.NextDouble() * (1L << 53)));
    }

    private static CollisionFilter DrawOften(SeededRandom from, double percent) => from.IsLucky(percent) ? Draw(from) : default;

    private static CollisionFilter Draw(SeededRandom from) => from.Pick(
        default, default, new CollisionFilter(2), new CollisionFilter(1, 1), new CollisionFilter(2, 1), new CollisionFilter(3, 2), CollisionFilter.None);
}
