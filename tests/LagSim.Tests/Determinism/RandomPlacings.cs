using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>Draws what becomes of spawns and teleports to a place that is taken, and more of them to places where others come by.</summary>
internal static class RandomPlacings
{
    internal static void AddTo(List<ExternalEvent> events, Random from)
    {
        for (int i = 0; i < events.Count; i++)
        {
            ExternalEvent e = events[i];
            events[i] = e.Kind switch
            {
                EventKind.Spawn => ExternalEvent.Spawn(e.Time, e.Peer, e.Sequence, e.Spec, e.Position, e.Velocity, e.Spin, Players(from), Occupied(from)),
                EventKind.Teleport => ExternalEvent.Teleport(e.Time, e.Peer, e.Sequence, e.Body, e.Position, e.Velocity, Occupied(from)),
                _ => e,
            };
        }

        SimTime[] times = [At(0.1), At(0.3), At(0.55), .. events.Select(e => e.Time)];
        int count = from.Next(2, 8);
        for (int i = 0; i < count; i++)
        {
            SimTime time = times[from.Next(times.Length)] + SimDuration.FromSeconds(from.Next(2) * from.NextDouble() * 0.4);
            time = time > At(RandomWorld.End) ? At(RandomWorld.End) : time;
            byte peer = (byte)from.Next(0, 4);
            Vector3D place = V(-1.5 + (from.Next(6) * 0.5), 2 + (from.Next(5) * 0.5), from.Next(2) / 8.0);
            events.Add(from.Next(3) == 0
                ? ExternalEvent.Teleport(time, peer, 7000u + (uint)i, BodyId.OfScene(from.Next(2)), place, V(from.Next(-1, 2)), Occupied(from))
                : ExternalEvent.Spawn(time, peer, 7000u + (uint)i, Ball(0.25), place, V(0, -from.Next(3)), default, Players(from), Occupied(from)));
        }
    }

    private static WhenOccupied Occupied(Random from) => (WhenOccupied)from.Next(3);

    private static PeerSet Players(Random from) => from.Next(2) == 0 ? default : PeerSet.Of(from.Next(4), from.Next(4));
}
