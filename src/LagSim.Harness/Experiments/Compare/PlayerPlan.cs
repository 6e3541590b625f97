using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>A seeded plan of all players' actions, drawn before any run so that every strategy and link gets the same plan.</summary>
/// <remarks>
/// It is drawn in a rehearsal, a simulation without a network, and places teleported and spawned bodies where that has room. In a run,
/// events come some microseconds earlier or later because clocks differ. In a chaotic scene the place may be taken by then, which is the
/// same for every strategy and link.
/// </remarks>
public sealed class PlayerPlan
{
    private const double SpeedSpread = 0.5;
    private const int MaxTries = 64;

    private static readonly SimDuration Earliest = SimDuration.FromSeconds(1);
    private static readonly SimDuration Latest = SimDuration.FromSeconds(6);

    /// <summary>The kinds of actions, drawn from this list.</summary>
    private static readonly EventKind[] Kinds =
    [
        EventKind.Impulse, EventKind.Impulse, EventKind.Impulse, EventKind.Impulse, EventKind.Impulse,
        EventKind.SetVelocity, EventKind.SetVelocity, EventKind.SetVelocity,
        EventKind.Teleport, EventKind.Teleport,
        EventKind.Spawn, EventKind.Spawn,
    ];

    private readonly Scene scene;
    private readonly SeededRandom random;
    private readonly Simulation rehearsal;
    private readonly uint[] sequences;
    private readonly Vector3D low;
    private readonly Vector3D high;
    private readonly Vector3D speed;

    private PlayerPlan(Scene scene, int peers, ulong seed)
    {
        this.scene = scene;
        random = new SeededRandom(seed).Fork(0xDEED);
        rehearsal = new Simulation(scene);
        sequences = new uint[peers];

        // The bodies' positions at the start give the extent of the scene, and the axes it uses: balls on a table stay on it.
        low = scene.Bodies.Select(b => b.Position).Aggregate((a, b) => new(Math.Min(a.X, b.X), Math.Min(a.Y, b.Y), Math.Min(a.Z, b.Z)));
        high = scene.Bodies.Select(b => b.Position).Aggregate((a, b) => new(Math.Max(a.X, b.X), Math.Max(a.Y, b.Y), Math.Max(a.Z, b.Z)));
        if (low == high)
        {
            double room = 4 * scene.Bodies[0].Spec.Radius;
            Vector3D up = scene.Gravity.Length > 0 ? scene.Gravity * (1 / scene.Gravity.Length) : new(1, 1, 1);
            Vector3D some = new(room * (0.25 + Math.Abs(up.X)), room * (0.25 + Math.Abs(up.Y)), room * (0.25 + Math.Abs(up.Z)));
            low -= some;
            high += some;
        }

        Vector3D extent = high - low;
        double most = Math.Max(extent.X, Math.Max(extent.Y, extent.Z));
        double usual = Math.Max(Math.Sqrt(2 * scene.Gravity.Length * most), scene.Bodies.Average(b => b.Velocity.Length));
        usual = SpeedSpread * (usual > 0 ? usual : most); // without motion or gravity: across the scene in a second or two
        speed = new(extent.X > 0 ? usual : 0, extent.Y > 0 ? usual : 0, extent.Z > 0 ? usual : 0);
    }

    /// <summary>Draws a plan. Returns the same plan for the same arguments. Cost: simulating the scene for some seconds.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="peers">The number of players, the host included.</param>
    /// <param name="seed">The seed of the random numbers.</param>
    /// <returns>The actions, in order of time. Every player acts within its rights: it spawns only where the scene allows it, and touches
    /// only bodies it may touch.</returns>
    /// <exception cref="SceneException">No player may touch any body.</exception>
    public static IReadOnlyList<PlannedAction> Draw(Scene scene, int peers, ulong seed)
    {
        ArgumentNullException.ThrowIfNull(scene);
        if (!scene.Bodies.Any(body => Enumerable.Range(0, peers).Any(body.Players.Contains)))
        {
            throw new SceneException($"In the scene '{scene.Name}' no body is there that any of {peers} peers may touch: there is nothing to compare.");
        }

        PlayerPlan plan = new(scene, peers, seed);
        EventKind[] kinds = plan.Shuffled(Kinds);
        SimDuration[] times = kinds.Select(_ => SimDuration.FromSeconds(plan.random.NextDouble(Earliest.ToSeconds(), Latest.ToSeconds()))).Order().ToArray();
        return kinds.Select((kind, n) => plan.Next(kind, times[n])).ToArray();
    }

    private PlannedAction Next(EventKind kind, SimDuration time)
    {
        SimTime at = rehearsal.Start + time;
        rehearsal.AdvanceTo(at);
        int[] spawners = Enumerable.Range(0, sequences.Length).Where(scene.Spawners.Contains).ToArray();
        PlannedAction? action = kind switch
        {
            EventKind.Spawn when spawners.Length > 0 => Spawn(spawners[Below(spawners.Length)], time, at),
            EventKind.Teleport => Teleport(time, at),
            EventKind.SetVelocity => Touch(EventKind.SetVelocity, time),
            _ => null,
        };
        action ??= Touch(EventKind.Impulse, time); // where there is no room, or no player may spawn
        rehearsal.Submit(action.ToAction().Stamp(at, (byte)action.Peer, ++sequences[action.Peer]));
        return action;
    }

    private PlannedAction Touch(EventKind kind, SimDuration time)
    {
        (int peer, BodyId body) = WhoAndWhom();
        Vector3D velocity = Velocity();
        return new PlannedAction(time, peer, kind, body, default, kind == EventKind.Impulse ? velocity * rehearsal.SpecOf(body).Mass : velocity, default);
    }

    private PlannedAction? Teleport(SimDuration time, SimTime at)
    {
        (int peer, BodyId body) = WhoAndWhom();
        return TryPlace(at, body, rehearsal.SpecOf(body).Radius, out Vector3D place)
            ? new PlannedAction(time, peer, EventKind.Teleport, body, place, Velocity(), default)
            : null;
    }

    private PlannedAction? Spawn(int peer, SimDuration time, SimTime at)
    {
        BodySpec spec = scene.Bodies[Below(scene.Bodies.Count)].Spec;
        BodyId body = new((byte)peer, sequences[peer] + 1, 0);
        return TryPlace(at, body, spec.Radius, out Vector3D place)
            ? new PlannedAction(time, peer, EventKind.Spawn, body, place, Velocity(), spec)
            : null;
    }

    /// <summary>Picks a body that some player may touch, and such a player.</summary>
    private (int Peer, BodyId Body) WhoAndWhom()
    {
        int[] touchable = Enumerable.Range(0, scene.Bodies.Count).Where(b => Touchers(b).Length > 0).ToArray();
        int body = touchable[Below(touchable.Length)];
        int[] peers = Touchers(body);
        return (peers[Below(peers.Length)], BodyId.OfScene(body));

        int[] Touchers(int b) => Enumerable.Range(0, sequences.Length).Where(scene.Bodies[b].Players.Contains).ToArray();
    }

    private bool TryPlace(SimTime at, BodyId whose, double radius, out Vector3D place)
    {
        for (int tries = 0; tries < MaxTries; tries++)
        {
            place = new(random.NextDouble(low.X, high.X), random.NextDouble(low.Y, high.Y), random.NextDouble(low.Z, high.Z));
            if (IsFree(at, whose, radius, place))
            {
                return true;
            }
        }

        place = default;
        return false;
    }

    private bool IsFree(SimTime at, BodyId whose, double radius, Vector3D place) =>
        scene.Planes.All(plane => plane.Gap(place, radius) >= 0)
        && scene.StaticSpheres.All(sphere => (sphere.Centre - place).Length >= sphere.Radius + radius)
        && Enumerable.Range(0, rehearsal.BodyCount).Select(rehearsal.BodyAt).All(other =>
            other == whose || !rehearsal.TryRead(other, at, out BodyState state) || (state.Position - place).Length >= rehearsal.SpecOf(other).Radius + radius);

    private Vector3D Velocity() => new(speed.X * random.NextGaussian(), speed.Y * random.NextGaussian(), speed.Z * random.NextGaussian());

    private int Below(int count) => (int)(random.NextDouble() * count);

    private EventKind[] Shuffled(EventKind[] kinds)
    {
        EventKind[] mixed = [.. kinds];
        for (int left = mixed.Length; left > 1; left--)
        {
            int n = Below(left);
            (mixed[n], mixed[left - 1]) = (mixed[left - 1], mixed[n]);
        }

        return mixed;
    }
}
