using System.Collections.Generic;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Harness.Verification.Worlds;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Harm;

/// <summary>Draws attacks by acts that each are harmless in most worlds, in scenes in which they once ended the world.</summary>
internal static class HarmActs
{
    private const int MaxBodies = 64;
    private const double MaxSpeed = 990;

    /// <summary>Any acts, as often as the host accepts, in one of the single worlds of <c>check</c>.</summary>
    internal static Scene DrawActs(SeededRandom random, List<HarmAction> actions)
    {
        ulong kind = (ulong)random.NextInt(WorldScenes.Kinds - 1); // the last has rules
        WorldScene world = WorldScenes.Draw(kind, random.Fork(1));
        DrawActs(random, world, actions);
        return world.Scene;
    }

    /// <summary>What makes rules be called as often as can be: balls that just fit, or any acts among balls that they hear.</summary>
    internal static Scene DrawRules(SeededRandom random, ulong seed, List<HarmAction> actions)
    {
        if (random.IsLucky(50))
        {
            return DrawFit(random, actions).With(new DrawnRules(seed), seed);
        }

        WorldScene world = WorldScenes.DrawRuled(random.Fork(1), seed);
        DrawActs(random, world, actions);
        return world.Scene;
    }

    private static void DrawActs(SeededRandom random, WorldScene world, List<HarmAction> actions)
    {
        double every = random.Pick(0.0025, 0.01, 0.05);
        int spawns = 0, bodies = world.Scene.Bodies.Count;
        for (double at = 0; at < HarmCase.Seconds; at += every)
        {
            EventKind act = random.Pick(
                EventKind.SetVelocity, EventKind.SetVelocity, EventKind.Teleport, EventKind.SetFilter, EventKind.Grab, EventKind.HoldKeyframe, EventKind.Spawn);
            act = act == EventKind.Spawn && spawns == MaxBodies ? EventKind.SetVelocity : act;
            bool isOwn = act != EventKind.Spawn && spawns > 0 && random.IsLucky(50);
            int spawn = isOwn ? random.NextInt(spawns) : -1, body = random.NextInt(bodies);
            Vector3D place = random.IsLucky(50) ? world.DrawPlace(random) : world.Scene.Bodies[random.NextInt(bodies)].Position;
            Vector3D velocity = WorldDraws.Direction(random) * WorldDraws.LogUniform(random, 0.1, MaxSpeed);
            actions.Add(new HarmAction(at, act, spawn, body, place, act is EventKind.SetVelocity or EventKind.Spawn ? velocity : default));
            spawns += act == EventKind.Spawn ? 1 : 0;
        }
    }

    /// <summary>Balls at one point, and more of them there again and again.</summary>
    internal static Scene DrawCrowd(SeededRandom random, List<HarmAction> actions)
    {
        Scene scene = Box(random, 2, random.Pick(0, 0.5, 1), 0.1);
        Vector3D point = new(0, random.Pick(0.1, 1), 0);
        double apart = random.Pick(0, 0, 1e-9, 1e-3);
        for (int n = 0; n < MaxBodies; n++)
        {
            actions.Add(new HarmAction(0.1, EventKind.Spawn, -1, 0, point + (WorldDraws.Direction(random) * apart)));
        }

        for (double at = 1; at < HarmCase.Seconds; at += 0.5)
        {
            for (int n = 0; n < MaxBodies; n++)
            {
                actions.Add(new HarmAction(at, EventKind.Teleport, n, 0, point));
            }
        }

        return scene;
    }

    /// <summary>Elastic balls that just fit between floor and ceiling, thrown up, where the scene's own ball has room.</summary>
    internal static Scene DrawFit(SeededRandom random, List<HarmAction> actions)
    {
        double radius = 0.5, slack = WorldDraws.LogUniform(random, 1e-9, 1e-4);
        Scene scene = Box(random, (2 * radius) + slack, 1, 0.1);
        BodySpec fitting = new(radius, random.Pick(0.1, 1, 10), 1);
        int count = 1 + random.NextInt(6);
        for (int n = 0; n < count; n++)
        {
            actions.Add(new HarmAction(0.1, EventKind.Spawn, -1, 0, new Vector3D((1.1 * n) - 2.5, radius + (slack / 2), 1.5)) { Spec = fitting });
            actions.Add(new HarmAction(0.2, EventKind.SetVelocity, n, 0, default, new Vector3D(0, WorldDraws.LogUniform(random, 1e-3, MaxSpeed), 0)));
        }

        return scene;
    }

    private static Scene Box(SeededRandom random, double height, double restitution, double radius) =>
        new SceneBuilder("box").WithSmallestRadius(radius).AddPlane("floor", Vector3D.Up, Vector3D.Zero, restitution)
            .AddPlane("ceiling", -Vector3D.Up, new Vector3D(0, height, 0), restitution)
            .AddBody("ball", new BodySpec(radius, random.Pick(0.1, 1, 10), restitution), new Vector3D(0, height / 2, -2)).Build();
}
