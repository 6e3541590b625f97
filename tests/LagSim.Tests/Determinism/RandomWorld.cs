using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>A scene and external events drawn by a seed: much symmetry and few different times, so that almost everything ties.</summary>
internal sealed class RandomWorld
{
    internal const double End = 1.25;

    private static readonly double[] Restitutions = [0, 0.05, 0.5, 0.8, 1];
    private static readonly double[] Masses = [0.5, 1, 1, 1, 3, 20];
    private static readonly double[] ExtremeMasses = [1e-30, 1e-3, 1, 1e6, 1e30];

    private readonly Random random;
    private readonly double[] masses;
    private readonly bool forced;
    private readonly int? sensorSeed;

    /// <summary>The world of a seed; with hands that take, move and let go of bodies besides, which nothing else in it depends on; with forces of all kinds in closed form and under error control, friction and spin.</summary>
    internal RandomWorld(
        int seed, bool hands = false, bool forced = false, bool filters = false, bool placings = false, bool sensors = false, bool rules = false)
    {
        this.forced = forced;
        sensorSeed = sensors ? seed + 2_000_000 : null;
        random = new Random(seed);
        masses = seed % 4 == 3 ? ExtremeMasses : Masses;
        Scene = DrawScene();
        Events = DrawEvents();
        HasHands = hands;
        if (hands)
        {
            DrawHands(new Random(seed + 1_000_000));
        }

        if (placings)
        {
            RandomPlacings.AddTo(Events, new Random(seed + 3_000_000));
        }

        if (filters)
        {
            Random drawn = new(seed + 2_000_000);
            Scene = RandomFilters.On(Scene, drawn);
            RandomFilters.AddTo(Events, drawn);
        }

        if (rules)
        {
            Scene = Scene.With(new DrawnRules((ulong)seed), (ulong)seed);
            DrawCommands(new Random(seed + 3_000_000));
        }
    }

    internal bool HasHands { get; }

    private void DrawCommands(Random draws)
    {
        for (uint n = 1; n <= 6; n++)
        {
            byte[] data = new byte[draws.Next(4)];
            draws.NextBytes(data);
            Events.Insert(0, PlayerAction.Command(new GameCommand(draws.Next(3), data)).Stamp(At(End * draws.Next(11) / 10), (byte)(1 + draws.Next(3)), 10_000 + n));
        }
    }

    /// <summary>How often an event came while the world of the last <see cref="Shuffled"/> had done a part of an instant.</summary>
    internal int PartDoneStops { get; private set; }

    internal Scene Scene { get; }

    /// <summary>What happens, in no particular order; no event twice.</summary>
    internal List<ExternalEvent> Events { get; }

    /// <summary>The instants at which hashes are compared.</summary>
    internal static IEnumerable<SimTime> Times => Enumerable.Range(0, 11).Select(i => At(End * i / 10));

    /// <summary>The world that had everything before it began.</summary>
    internal Simulation OnTime(IEnumerable<ExternalEvent>? events = null, Scene? scene = null, SimulationOptions? options = null)
    {
        Simulation simulation = new(scene ?? Scene, options ?? KeepAll);
        foreach (ExternalEvent external in events ?? Events)
        {
            simulation.Submit(external);
        }

        simulation.AdvanceTo(simulation.Start + SimDuration.FromSeconds(End));
        return simulation;
    }

    /// <summary>The world that goes on from a snapshot of another that had everything.</summary>
    internal Simulation GoOnFrom(Simulation whole, SimTime cut)
    {
        Simulation rest = new(Scene, whole.Snapshot(cut), KeepAll);
        foreach (ExternalEvent external in Events.Where(e => e.Time >= cut))
        {
            rest.Submit(external);
        }

        rest.AdvanceTo(At(End));
        return rest;
    }

    /// <summary>
    /// A world that hears of everything in some order, at any moment of its progress, some of it twice, and of some things that are retracted
    /// again. With a history, never later than that allows. In pieces, it goes on by a few events at a time, and more events may come before what
    /// a late event rewinds is simulated again.
    /// </summary>
    internal Simulation Shuffled(
        int seed,
        SimDuration? history = null,
        Action<Simulation>? prepare = null,
        HealingMode mode = HealingMode.CausalCone,
        bool inPieces = false,
        int bruteForceLimit = SimulationOptions.DefaultBruteForceLimit,
        IImpactObserver? observer = null,
        EngineParts? parts = null)
    {
        Random arrivals = new(seed);
        SimulationOptions options = new SimulationOptions(default, history ?? SimDuration.MaxValue, healing: mode).WithBruteForceLimit(bruteForceLimit);
        Simulation simulation = new(Scene, options.WithObserver(observer).WithParts(parts ?? EngineParts.Usual));
        prepare?.Invoke(simulation);
        double latest = history is SimDuration kept ? kept.ToSeconds() * 0.999 : End;
        List<(double When, ExternalEvent Event, bool Retracts)> lateEvents = [];
        foreach (ExternalEvent external in Events)
        {
            double stamp = external.Time.ToSeconds();
            double When() => Math.Max(0, Math.Min(stamp + latest, arrivals.Next(4) == 0 ? stamp : stamp + (latest * ((arrivals.NextDouble() * 1.5) - 0.5))));
            lateEvents.Add((When(), external, false));
            if (arrivals.Next(3) == 0)
            {
                lateEvents.Add((When(), external, false)); // heard twice
            }
        }

        for (int i = 0; i < 2; i++)
        {
            // What turns out never to have been: submitted first, retracted later.
            ExternalEvent never = Decoy(arrivals, i);
            double heard = Math.Min(never.Time.ToSeconds() + (latest * arrivals.NextDouble()), End);
            double takenBack = Math.Min(heard + (arrivals.NextDouble() * 0.3), never.Time.ToSeconds() + latest);
            lateEvents.Add((Math.Min(heard, takenBack), never, false));
            lateEvents.Add((takenBack, never, true));
        }

        foreach ((double when, ExternalEvent external, bool retracts) in lateEvents.OrderBy(n => n.When))
        {
            SimTime now = At(Math.Min(when, End));
            long most = inPieces ? arrivals.Next(8) : long.MaxValue;
            simulation.TryAdvanceTo(SimTime.Max(now, simulation.SimulatedTo), ref most);
            PartDoneStops += simulation.Engine.Loop.IsPartDone ? 1 : 0;
            if (retracts)
            {
                simulation.Retract(external);
            }
            else if (simulation.Submit(external) == SubmitResult.TooOld)
            {
                throw new InvalidOperationException($"Too old at {now}: {external}");
            }

            if (arrivals.Next(5) == 0 && simulation.SimulatedTo >= simulation.HistoryEdge) // else an event of the first instant came late
            {
                simulation.StateHash(simulation.SimulatedTo); // reading leaves no trace
            }
        }

        simulation.Work = null; // nobody stops it any more
        simulation.AdvanceTo(At(End));
        return simulation;
    }

    /// <summary>The first instant at which two worlds differ; null if they agree in every bit that is compared.</summary>
    internal static string? Difference(Simulation expected, Simulation actual)
    {
        foreach (SimTime time in Times.Where(t => t >= expected.HistoryEdge && t >= actual.HistoryEdge))
        {
            if (expected.StateHash(time) != actual.StateHash(time))
            {
                return $"other states at {time}";
            }

            if (expected.EventHash(time) != actual.EventHash(time))
            {
                return $"other events up to {time}";
            }
        }

        return null;
    }

    private T Pick<T>(params T[] from) => from[random.Next(from.Length)];

    private Scene DrawScene()
    {
        SceneBuilder builder = new SceneBuilder("random").WithSmallestRadius(0.25);
        bool falls = random.Next(5) > 0;
        if (!falls)
        {
            builder.WithGravity(Floating);
        }

        builder.AddPlane("floor", Pick(Vector3D.Up, Vector3D.Up, V(0.6, 0.8)), V(0), Pick(Restitutions));
        if (random.Next(2) == 0)
        {
            builder.AddPlane("west", V(1), V(-3), Pick(Restitutions)).AddPlane("east", V(-1), V(5), Pick(Restitutions));
        }

        if (random.Next(2) == 0)
        {
            builder.AddStaticSphere("dome", V(1, -4, 0), 5, Pick(Restitutions)); // its top is at 1 m
        }

        builder.AddForce(Force.Supplied(new FunctionForce((t, x, v) => (v * -0.3) + V(-x.X, t, 0))));
        if (forced)
        {
            builder.AddForce(Force.LinearDrag("oil", 0.4, V(0.3))).AddForce(Force.Spring("spring", V(0, 3), 2, 0.1)).AddForce(Force.Magnetic("coil", V(0, 0.5, 1), 1.5))
                .AddForce(Force.QuadraticDrag("air", 0.2)).AddForce(Force.Central("well", V(0.1, 3.1, 0.05), 2, -1));
        }

        bool oneHeight = random.Next(2) == 0;
        double height = 2 + (random.Next(8) / 8.0);
        int bodies = random.Next(2, 9);
        int integrated = random.Next(3);
        for (int i = 0; i < bodies; i++)
        {
            Vector3D x = V(-2 + (0.75 * (i % 4)) + 0.5, (oneHeight ? height : height + (random.Next(4) / 4.0)) + (i / 4 * 2), random.Next(2) / 8.0);
            builder.AddBody($"ball {i}", DrawSpec(integrated), x, V(Pick(-1.0, 0, 0, 1), Pick(0, 0, -2.0), Pick(0, 0, 0.5)), spin: forced && i % 3 == 0 ? V(3, -2, 5) : Vector3D.Zero);
        }

        if (random.Next(2) == 0)
        {
            // Three that meet at one tick, half a second on, unless something happens to them before.
            builder.AddBody("left", DrawSpec(0), V(-1.5, 6, 3), V(2, 0, 0))
                .AddBody("middle", DrawSpec(0), V(0, 6, 3))
                .AddBody("right", DrawSpec(0), V(1.5, 6, 3), V(-2, 0, 0));
        }

        if (sensorSeed is int drawn)
        {
            DrawSensors(builder, new Random(drawn), bodies);
        }

        return builder.Build();
    }

    /// <summary>Regions where the bodies are, or that they carry: some of them with their boundary where bodies start, bounce or rest.</summary>
    private static void DrawSensors(SceneBuilder builder, Random from, int bodies)
    {
        int count = from.Next(1, 9);
        for (int i = 0; i < count; i++)
        {
            SensorCoverage coverage = (SensorCoverage)from.Next(3);
            if (from.Next(2) == 0)
            {
                Vector3D normal = from.Next(4) switch { 0 => Vector3D.Up, 1 => V(1), 2 => V(-1, 1), _ => V(from.NextDouble() - 0.5, from.NextDouble(), from.NextDouble() - 0.5) };
                builder.AddSensorPlane($"behind {i}", normal, from.Next(3) == 0 ? 0.25 * from.Next(0, 12) : from.NextDouble() * 4, coverage);
            }
            else
            {
                bool isCarried = from.Next(2) == 0;
                Vector3D place = isCarried ? V(from.Next(-1, 2) * 0.25) : V(from.Next(-4, 5) * 0.5, from.Next(0, 9) * 0.5, from.Next(3) * 0.125);
                builder.AddSensorSphere($"in {i}", place, from.Next(1, 8) * 0.25, coverage, carrier: isCarried ? $"ball {from.Next(bodies)}" : null);
            }
        }
    }

    private BodySpec DrawSpec(int integrated)
    {
        if (forced && random.Next(2) == 0)
        {
            ForceSet forces = Pick(ForceSet.Of(1), ForceSet.Of(2), ForceSet.Of(3), ForceSet.Of(1) | ForceSet.Of(2) | ForceSet.Of(3), ForceSet.Of(4), ForceSet.Of(5) | ForceSet.Of(0));
            return new BodySpec(
                Pick(0.25, 0.25, 0.3125), Pick(1.0, 1, 2, 50), Pick(Restitutions), Pick(MotionLaw.Automatic, MotionLaw.Automatic, MotionLaw.DormandPrince54),
                LagSim.Time.SimDuration.FromSeconds(Pick(0.03125, 0.05)), forces, Pick(0, 1e-4, 1e-6), Pick(0, 0.5), 0.01);
        }

        if (forced && random.Next(3) > 0)
        {
            return new BodySpec(Pick(0.25, 0.25, 0.3125), Pick(1.0, 1, 2, 50), Pick(Restitutions), friction: Pick(0.1, 0.5, 2), rollingResistance: Pick(0, 0.05));
        }

        bool steps = integrated > random.Next(3);
        double radius = Pick(0.25, 0.25, 0.3125), mass = Pick(masses);

        // An elastic ball that is squeezed by one of twelve decades more has a million impacts, all of which happen.
        double restitution = Math.Min(Pick(Restitutions), masses == ExtremeMasses ? 0.8 : 1);
        return Ball(
            radius, mass, restitution, steps ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic,
            steps ? Pick(0.03125, 0.03125, 0.05) : 0, (byte)(steps ? random.Next(2) : 0));
    }

    private List<ExternalEvent> DrawEvents()
    {
        // Times: a few round ones, and those at which something happens anyway, with the ticks next to them.
        Simulation quiet = Run(Scene, End);
        SimTime[] busy = Bodies(quiet).SelectMany(body => quiet.Timeline(body)).Select(entry => entry.Key.Time)
            .Concat(quiet.Crossings(At(0), At(End)).Select(crossing => crossing.Time)).Where(time => time > At(0) && time < At(End)).Distinct().OrderBy(_ => random.Next()).Take(3).ToArray();
        List<SimTime> times = [At(0), At(0.25), At(0.5), At(0.5), .. busy, .. busy];
        times.AddRange(busy.Select(time => time + SimDuration.OneTick));
        times.AddRange(busy.Select(time => time - SimDuration.OneTick));
        List<BodyId> known = Bodies(quiet).ToList();
        uint[] sequences = new uint[4];
        List<ExternalEvent> events = [];
        int count = random.Next(3, 9);
        for (int i = 0; i < count; i++)
        {
            byte peer = (byte)random.Next(0, 4);
            uint sequence = ++sequences[peer];
            SimTime time = times[random.Next(times.Count)];
            BodyId body = known[random.Next(known.Count)];
            if (random.Next(4) == 0)
            {
                ExternalEvent spawn = ExternalEvent.Spawn(time, peer, sequence, DrawSpec(1), Place(), V(0, Pick(0.0, -3)));
                known.Add(spawn.Body);
                known.Add(spawn.Body); // things happen to it, before it is there as well
                events.Add(spawn);
            }
            else
            {
                events.Add(ScriptedAction(random, time, peer, sequence, body));
            }
        }

        return events;
    }

    /// <summary>A few hands, most of them on the same bodies: keyframes in quick succession and slow, early, late and of who does not hold, with and without an end.</summary>
    private void DrawHands(Random from)
    {
        List<BodyId> known = [.. Events.Select(e => e.Body), BodyId.OfScene(0), BodyId.OfScene(1)];
        SimTime[] times = [At(0), At(0.25), At(0.5), .. Events.Select(e => e.Time)];
        BodyId favourite = known[from.Next(known.Count)];
        int hands = from.Next(1, 5);
        for (int hand = 0; hand < hands; hand++)
        {
            byte peer = (byte)from.Next(0, 4);
            uint sequence = 100u + ((uint)hand * 100);
            BodyId body = from.Next(3) > 0 ? favourite : known[from.Next(known.Count)];
            SimTime time = times[from.Next(times.Length)];
            Events.Add(ExternalEvent.Grab(time, peer, ++sequence, body, V(from.Next(2) * 0.125, from.Next(2) * 0.125)));
            int keyframes = from.Next(0, 9);
            Vector3D at = V(from.Next(-2, 4) * 0.5, 0.5 + (from.Next(6) * 0.5), from.Next(2) * 0.125);
            for (int keyframe = 0; keyframe < keyframes; keyframe++)
            {
                Vector3D speed = V(from.Next(-3, 4), from.Next(-3, 4), from.Next(-1, 2) * 0.5);
                Events.Add(ExternalEvent.HoldKeyframe(time, peer, ++sequence, body, at, speed));
                double gap = from.Next(4) switch { 0 => 0.05, 1 => 0.2, 2 => from.NextDouble() * 0.03, _ => from.NextDouble() * 0.3 };
                time += SimDuration.FromSeconds(gap);
                at += (speed * (gap * 0.75)) + V(from.Next(-1, 2) * 0.0625, 0);
            }

            if (from.Next(3) > 0)
            {
                Events.Add(ExternalEvent.Release(time, peer, ++sequence, body, V(from.Next(-2, 3), from.Next(-2, 4))));
            }
        }

        Events.RemoveAll(e => e.Time > At(End));
    }

    private Vector3D Place() => V(Pick(0.0, 0.5, 1, 2), Pick(4.0, 4, 3.5), Pick(0, 0.25));

    private ExternalEvent ScriptedAction(Random from, SimTime time, byte peer, uint sequence, BodyId body) => from.Next(5) switch
    {
        0 => ExternalEvent.Remove(time, peer, sequence, body),
        1 => ExternalEvent.SetVelocity(time, peer, sequence, body, V(from.Next(-2, 3), from.Next(-2, 3))),
        2 => ExternalEvent.Impulse(time, peer, sequence, body, V(from.Next(-1, 2), from.Next(0, 4))),
        _ => ExternalEvent.Teleport(time, peer, sequence, body, V(from.Next(0, 4) * 0.5, 3.5 + (from.Next(3) * 0.5)), V(0, from.Next(-2, 1))),
    };

    private ExternalEvent Decoy(Random arrivals, int i)
    {
        SimTime time = Events.Count > 0 && arrivals.Next(2) == 0 ? Events[arrivals.Next(Events.Count)].Time : At(arrivals.NextDouble() * End);
        if (Scene.Rules is not null && arrivals.Next(3) == 0)
        {
            return PlayerAction.Command(new GameCommand(7)).Stamp(time, 9, (uint)i + 1);
        }

        if (HasHands && arrivals.Next(2) == 0)
        {
            // Of a body that hands are at: one that took it first, or let go of it for another.
            ExternalEvent hand = Events[^1];
            BodyId body = hand.Body;
            return arrivals.Next(3) switch
            {
                0 => ExternalEvent.Grab(time, 9, (uint)i + 1, body),
                1 => ExternalEvent.HoldKeyframe(time, hand.Peer, (uint)i + 9001, body, V(arrivals.Next(4), 2), V(arrivals.Next(3))),
                _ => ExternalEvent.Release(time, hand.Peer, (uint)i + 9001, body, V(0, arrivals.Next(5))),
            };
        }

        return arrivals.Next(4) == 0
            ? ExternalEvent.Spawn(time, 9, (uint)i + 1, Ball(0.25), V(arrivals.Next(4), 4), V(0, -2))
            : ScriptedAction(arrivals, time, 9, (uint)i + 1, BodyId.OfScene(arrivals.Next(Scene.Bodies.Count)));
    }
}
