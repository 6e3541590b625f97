using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Sessions;

/// <summary>What players do, drawn by a seed: everything that can be done, by everybody, to what anybody brought into the world.</summary>
internal sealed class ScriptedActions(int seed, int maxSpawns = int.MaxValue)
{
    private readonly Random random = new(seed);
    private readonly List<BodyId> bodies = [];
    private int spawns;

    /// <summary>A box without a lid, in it balls on either law, near enough to meet.</summary>
    internal static Scene Box(double e = 0.8)
    {
        SceneBuilder builder = new SceneBuilder("box").WithSmallestRadius(0.25)
            .AddPlane("floor", Vector3D.Up, V(0), 0.9).AddPlane("west", V(1), V(-3), 0.9).AddPlane("east", V(-1), V(3), 0.9);
        for (int i = 0; i < 4; i++)
        {
            MotionLaw law = i == 3 ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic;
            builder.AddBody($"ball {i}", Ball(0.3, 1 + i, e, law, law == MotionLaw.Ballistic ? 0 : 0.02), V(-2 + (1.2 * i), 1.5 + (0.25 * i)), V(1 - i));
        }

        return builder.Build();
    }

    /// <summary>Has random peers do random things at random moments.</summary>
    /// <returns>What was done.</returns>
    internal List<ExternalEvent> DoIn(SessionGroup group, int count, double meanPause = 0.08)
    {
        bodies.AddRange(Enumerable.Range(0, group.Scene.Bodies.Count).Select(BodyId.OfScene));
        List<ExternalEvent> done = [];
        while (done.Count < count)
        {
            ExternalEvent external = group.Do(random.Next(group.Sessions.Count), Draw());
            done.Add(external);
            if (external.Kind == EventKind.Spawn)
            {
                bodies.Add(external.Body); // others may act on it before they have heard of it
            }

            if (random.Next(4) > 0)
            {
                group.Run(random.NextDouble() * 2 * meanPause);
            }
        }

        return done;
    }

    /// <summary>Has hands as well, which take, move and let go of what they may hold or not.</summary>
    internal bool HasHands { get; init; }

    private PlayerAction Draw()
    {
        BodyId body = bodies[random.Next(bodies.Count)];
        if (HasHands && random.Next(2) == 0)
        {
            return random.Next(4) switch
            {
                0 => PlayerAction.Grab(body, V(0, 0.1)),
                1 => PlayerAction.Release(body, Speed(4)),
                _ => PlayerAction.HoldKeyframe(body, Place(), Speed(2)),
            };
        }

        return random.Next(12) switch
        {
            0 or 1 when spawns++ < maxSpawns => PlayerAction.Spawn(Ball(0.25 + (0.1 * random.NextDouble()), 1, 0.7, random.Next(3) == 0 ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic), Place(), Speed(3)),
            2 => PlayerAction.Remove(body),
            3 or 4 or 5 => PlayerAction.Teleport(body, Place(), Speed(2)),
            6 or 7 or 8 => PlayerAction.SetVelocity(body, Speed(5)),
            _ => PlayerAction.Impulse(body, Speed(4)),
        };
    }

    private Vector3D Place() => V((random.NextDouble() * 4) - 2, 1 + (random.NextDouble() * 3), (random.NextDouble() - 0.5) * 0.2);

    private Vector3D Speed(double most) => V((random.NextDouble() - 0.5) * most, (random.NextDouble() - 0.3) * most, 0);
}
