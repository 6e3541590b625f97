using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>The hands of a seeded session.</summary>
internal static class CheckHands
{
    private const int FewestKeyframes = 2;
    private const int MaxKeyframes = 10;

    /// <summary>
    /// Draws hands that grab a body, move it and release it, or stop sending keyframes. Often two are after the same body.
    /// </summary>
    /// <param name="actions">The actions of a session, to which those of the hands are added by time.</param>
    /// <param name="room">Its scene.</param>
    /// <param name="players">The number of its players.</param>
    /// <param name="random">The stream to draw from.</param>
    internal static void AddTo(List<CheckAction> actions, CheckScene room, int players, SeededRandom random)
    {
        List<CheckAction> all = [.. actions];
        int[] spawns = [.. Enumerable.Range(0, actions.Count).Where(i => actions[i].Kind == EventKind.Spawn)];
        int hands = room.FewestHands + random.NextInt(room.MaxHands - room.FewestHands + 1);
        CheckAction? before = null;
        for (int hand = 0; hand < hands; hand++)
        {
            int spawn = spawns.Length > 0 && random.IsLucky(20) ? random.Pick(spawns) : -1;
            int body = spawn >= 0 ? -1 : room.DrawHeld(random);
            double at = spawn >= 0
                ? random.NextDouble(actions[spawn].AtSeconds, room.BusySeconds)
                : random.NextDouble(0, room.GraspSeconds);
            if (before is not null && random.IsLucky(50))
            {
                (spawn, body) = (before.Spawn, before.Body);
                at = Math.Min(CheckCase.Length, before.AtSeconds + random.Pick(0, 0, random.NextDouble()));
            }

            CheckAction action = new(
                at, random.NextInt(players), EventKind.Grab, body, spawn,
                new Vector3D(random.NextDouble(-0.1, 0.1), random.NextDouble(-0.1, 0.1), 0), default, default);
            all.Add(action);
            before = action;
            Vector3D position = room.DrawPosition();
            int keyframes = FewestKeyframes + random.NextInt(MaxKeyframes - FewestKeyframes + 1);
            for (; keyframes > 0 && at < CheckCase.Length; keyframes--)
            {
                // A part of the way to any place in the room, so that it stays in the room.
                double gap = random.Pick(0.02, 0.1, 0.1, 0.3);
                Vector3D velocity = (room.DrawPosition() - position) * 1.5;
                all.Add(action with { AtSeconds = at, Kind = EventKind.HoldKeyframe, Position = position, Velocity = velocity });
                position += velocity * gap;
                at += gap;
            }

            if (at < CheckCase.Length && random.IsLucky(70))
            {
                all.Add(action with { AtSeconds = at, Kind = EventKind.Release, Velocity = room.DrawVelocity(6) });
            }
        }

        PutInOrder(actions, all);
    }

    /// <summary>Makes these the actions: by time, those of one instant in the order drawn. References to spawns are updated to the new order.</summary>
    internal static void PutInOrder(List<CheckAction> actions, List<CheckAction> all)
    {
        int[] order = [.. Enumerable.Range(0, all.Count).OrderBy(i => all[i].AtSeconds)];
        int[] place = new int[order.Length];
        for (int i = 0; i < order.Length; i++)
        {
            place[order[i]] = i;
        }

        actions.Clear();
        actions.AddRange(order.Select(i => all[i].Spawn < 0 ? all[i] : all[i] with { Spawn = place[all[i].Spawn] }));
    }
}
