using System.Collections.Generic;
using System.Linq;
using LagSim.Corpus;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Corpus;

/// <summary>The worlds of the corpus. What each covers stands in <c>tests/corpus/README.md</c>.</summary>
internal static class CorpusWorlds
{
    /// <summary>All of them.</summary>
    internal static IEnumerable<CorpusWorld> All =>
    [
        World("drop-rk4", BuiltInScenes.Drop(), 20, ExternalEvent.Teleport(At(3), 1, 1, First, V(0, 15))),
        World("drop-ballistic", BuiltInScenes.Drop(law: MotionLaw.Ballistic), 45, ExternalEvent.Teleport(At(20), 1, 1, First, V(0, 15), V(0.1))),
        World(
            "pair", BuiltInScenes.Pair(), 10, ExternalEvent.Impulse(At(2.5), 1, 1, First, V(0.3, 4, -0.1)),
            ExternalEvent.SetVelocity(At(4), 2, 1, Second, V(-1, 5, 0.7))),
        World("cradle", BuiltInScenes.Cradle(), 16, ExternalEvent.Impulse(At(8.3), 1, 1, Third, V(0.7))),
        World("billiards", BuiltInScenes.Billiards(), 4, ExternalEvent.SetVelocity(At(2.5), 1, 1, First, V(-3, 0, 2.3))),
        World(
            "crowd", BuiltInScenes.Crowd(27), 3, ExternalEvent.Remove(At(1), 1, 1, BodyId.OfScene(4)),
            ExternalEvent.Spawn(At(1.5), 2, 1, Ball(0.2, 0.5), BuiltInScenes.Crowd(27).Bodies[4].Position, V(3, 1, -2))),
        MassRatios(),
        Carried(),
        Dome(),
        Pile(),
        Grooves(),
        Wake(),
        Together(),
        Jammed(),
        FarAndLate(),
        Supplied(),
        Ties(),
        SmallAndFast(),
        Subnormal(),
        ScriptedActions(),
        Held(),
        Forces(),
        Orbits(),
        Rough(),
    ];

    private static CorpusWorld World(string name, Scene scene, double seconds, params ExternalEvent[] events) =>
        new(name, scene, CorpusWorld.Accepted(events), seconds, 20, SimTime.Zero);

    /// <summary>A row of masses up to twelve decades apart, a billiard of ten thousand to one against a wall, and a light ball, inelastic, squeezed by 1e30 kg.</summary>
    private static CorpusWorld MassRatios()
    {
        SceneBuilder builder = new SceneBuilder("mass ratios").WithGravity(Floating).AddPlane("wall", V(1), V(-10));
        (double Mass, double X, double Y, double Speed)[] balls =
        [
            (1, 0, 0, 1), (1e12, 2, 0, 0), (10, 4, 0, 0), (1e6, 7, 0, -0.5), (1, 9, 0, -2),
            (1, -8, 100, 0), (1e4, -6, 100, -1),
            (1, -9.5, 200, 0), (1e30, 0.5, 200, -1), // XX
        ];
        for (int i = 0; i < balls.Length; i++)
        {
            builder.AddBody($"ball {i}", Ball(mass: balls[i].Mass, e: i < 7 ? 1 : 0.5), V(balls[i].X, balls[i].Y), V(balls[i].Speed));
        }

        return World("mass-ratios", builder.Build(), 10);
    }

    /// <summary>
    /// Hands: one takes a ball, strikes another with it and throws it; two that want the same ball; one that presses a ball on the floor and falls silent; keyframes of
    /// one that holds nothing.
    /// </summary>
    private static CorpusWorld Held()
    {
        Scene scene = new SceneBuilder("held").AddPlane("floor", Vector3D.Up, V(0), 0.7).AddStaticSphere("stone", V(6, 0, 0), 1, 0.5)
            .AddBody("bat", Ball(0.3, 2, 0.9), V(-2, 0.3)).AddBody("struck", Ball(0.3, 1, 0.8), V(-0.5, 0.3))
            .AddBody("wanted", Ball(0.25, 1, 0.5, MotionLaw.RungeKutta4), V(3, 2), V(0, 1)).AddBody("under", Ball(0.3, 1, 0.4), V(3.1, 0.3, 2)).Build();
        BodyId bat = First, wanted = Third;
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0.3), 1, 1, bat, V(0, 0.1)), ExternalEvent.Grab(At(0.5), 2, 1, wanted), ExternalEvent.Grab(At(0.5), 3, 1, wanted, V(0.1))];
        for (uint n = 0; n < 14; n++)
        {
            double t = 0.3 + (0.07 * n);
            events.Add(ExternalEvent.HoldKeyframe(At(t), 1, n + 2, bat, V(-2 + (0.13 * n), 0.4 + (0.01 * n * n), 0.003 * n), V(2, 0.3, 0.05)));
            events.Add(ExternalEvent.HoldKeyframe(At(t + 0.21), 2, n + 2, wanted, V(3, 2 - (0.13 * n), 0.15 * n), V(0.1, -1.8, 2)));
            events.Add(ExternalEvent.HoldKeyframe(At(t + 0.22), 3, n + 2, wanted, V(9, 9, 9), V(1)));
        }

        events.Add(ExternalEvent.Release(At(1.3), 1, 20, bat, V(4, 3, -0.2)));
        events.Add(ExternalEvent.Impulse(At(1.4), 3, 20, wanted, V(9)));
        events.Add(ExternalEvent.Grab(At(3.1), 3, 21, wanted, V(0, -0.2)));
        return World("held", scene, 5, [.. events]);
    }

    /// <summary>A light ball that carries one a million times as heavy, and three on a floor of which the middle one is sixty decades lighter.</summary>
    private static CorpusWorld Carried() => World(
        "carried",
        new SceneBuilder("carried").AddStaticSphere("dome", V(0, -5), 5, 0.5).AddPlane("floor", Vector3D.Up, V(0, -10), 0.5)
            .AddBody("light", Ball(e: 0.5), V(0, 0.5)).AddBody("heavy", Ball(mass: 1e6, e: 0.5), V(0, 1.5))
            .AddBody("below", Ball(e: 0.9), V(20, -9.5)).AddBody("feather", Ball(mass: 1e-30, e: 0.9), V(20, -8.5))
            .AddBody("above", Ball(mass: 1e30, e: 0.9), V(20, -7.5 + 1e-4)).Build(),
        0.25);

    /// <summary>A ball that rolls off a dome by hops, and one caught in the pit between three static spheres.</summary>
    private static CorpusWorld Dome() => World(
        "dome",
        new SceneBuilder("dome").AddPlane("floor", Vector3D.Up, V(0, -2), 0).AddStaticSphere("dome", V(0), 1, 0.3)
            .AddStaticSphere("stone 1", V(10, 0, 0.6), 0.6, 0.5).AddStaticSphere("stone 2", V(10, 0, -0.6), 0.6, 0.5).AddStaticSphere("stone 3", V(11, 0, 0), 0.6, 0.5)
            .AddBody("rolls", Ball(), V(0.01, 1.6)).AddBody("caught", Ball(e: 0.4), V(10.4, 2, 0.05)).Build(),
        3);

    /// <summary>Seven balls of all masses heaped into a groove around a stone.</summary>
    private static CorpusWorld Pile()
    {
        SceneBuilder builder = new SceneBuilder("pile").AddPlane("left", V(0.6, 0.8), V(0), 0.5).AddPlane("right", V(-0.6, 0.8), V(0), 0.5)
            .AddStaticSphere("stone", V(0, 0), 0.5, 0.3);
        for (int i = 0; i < 7; i++)
        {
            builder.AddBody($"ball {i}", Ball(0.25, 1 + i, 0.6), V(((i * 7) % 5 * 0.1) - 0.2, 1.5 + (0.6 * i), 0.01 * i));
        }

        return World("pile", builder.Build(), 2);
    }

    /// <summary>Slides on a plane, along a groove and into a corner, by both laws of flight, under gravity that points along the groove too.</summary>
    private static CorpusWorld Grooves() => World(
        "grooves",
        new SceneBuilder("grooves").WithGravity(V(0, -9.81, 0.7)).AddPlane("left", V(0.6, 0.8), V(0), 0.5).AddPlane("right", V(-0.28, 0.96), V(0), 0.4)
            .AddPlane("end", V(0, 0.1, -1), V(0, 0, 9), 0.6)
            .AddBody("along", Ball(e: 0.5), V(0.1, 1.2), V(0.2, 0, 1)).AddBody("steps", Ball(0.25, 3, 0.7, MotionLaw.RungeKutta4), V(-0.3, 2, -4), V(1, 0, 0.5))
            .AddBody("across", Ball(0.3, 2, 0.3), V(6, 3, -8), V(0, 0, -0.3)).Build(),
        8);

    /// <summary>Balls at rest on planes, woken by a ball that runs into them, by an impulse, and by one that is spawned above; one is taken from under another.</summary>
    private static CorpusWorld Wake()
    {
        SceneBuilder builder = new SceneBuilder("wake").AddPlane("floor", Vector3D.Up, V(0), 0.6).AddPlane("west", V(1), V(-31), 0.6)
            .AddBody("runs", Ball(e: 0.6), V(-30, 0.5), V(7)).AddBody("rests", Ball(mass: 2, e: 0.6), V(0, 0.5)).AddBody("in the corner", Ball(e: 0.3), V(9, 0.5, 3));
        builder.AddBody("steps", Ball(0.3, 1, 0.2, MotionLaw.RungeKutta4), V(9, 0.3)).AddBody("below", Ball(e: 0.2), V(15, 0.5)).AddBody("above", Ball(e: 0.2), V(15, 1.5));
        return World(
            "wake", builder.Build(), 12,
            ExternalEvent.Impulse(At(1.25), 1, 1, BodyId.OfScene(3), V(0.1, 2, 0.05)),
            ExternalEvent.Spawn(At(2), 2, 1, Ball(0.5, 0.5, 0.7), V(9.1, 4, 3)),
            ExternalEvent.Remove(At(0.625), 1, 2, BodyId.OfScene(4)),
            ExternalEvent.Teleport(At(4), 1, 3, First, V(-2, 0.5), V(3, 0, 0.25)));
    }

    /// <summary>Impacts of many bodies: a break, six from all sides at one tick, one onto two that lie on the floor.</summary>
    private static CorpusWorld Together()
    {
        SceneBuilder builder = new SceneBuilder("together").AddPlane("floor", Vector3D.Up, V(0, -50), 0.9)
            .AddBody("cue", Ball(), V(-3, 0, 0), V(2)).AddBody("left", Ball(e: 0.9), V(0, 0, -0.5)).AddBody("right", Ball(e: 0.9), V(0, 0, 0.5))
            .AddBody("middle", Ball(mass: 5), V(20, 0))
            .AddBody("pair 1", Ball(e: 0.9), V(40, -49.5)).AddBody("pair 2", Ball(mass: 3, e: 0.9), V(41, -49.5)).AddBody("onto", Ball(mass: 2), V(40.5, -45));
        Vector3D[] sides = [V(3), V(-3), V(0, 3), V(0, -3), V(0, 0, 3), V(0, 0, -3)];
        for (int i = 0; i < sides.Length; i++)
        {
            builder.AddBody($"side {i}", Ball(mass: 1 + (i * 0.25)), V(20, 0) + sides[i], sides[i] * -1.5);
        }

        return World("together", builder.Build(), 4);
    }

    /// <summary>What collapses: a row that just fits between walls, with a ball falling into it, and three balls below the threshold of inelastic collapse.</summary>
    private static CorpusWorld Jammed() => World(
        "squeezed",
        new SceneBuilder("squeezed").AddPlane("floor", Vector3D.Up, V(0, -20), 0.5).AddPlane("west", V(1), V(-1.5 - 1e-8), 0.5).AddPlane("east", V(-1), V(1.5 + 1e-8), 0.5)
            .AddBody("left", Ball(e: 0.8), V(-1, -19.5)).AddBody("right", Ball(e: 0.8), V(1, -19.5)).AddBody("falls", Ball(e: 0.8), V(0.003, -18.45))
            .AddBody("row 1", Ball(0.25, 1, 0.02), V(-1, -5, 5), V(1)).AddBody("row 2", Ball(0.25, 1, 0.02), V(0, -5, 5))
            .AddBody("row 3", Ball(0.25, 1, 0.02), V(1.1, -5, 5), V(-1)).Build(),
        1.5);

    /// <summary>A start forty days from the origin of time and a thousand kilometres from that of space.</summary>
    private static CorpusWorld FarAndLate()
    {
        const double far = 1e6;
        SimTime start = At(3_456_789.123);
        SceneBuilder builder = new SceneBuilder("far and late").AddPlane("floor", Vector3D.Up, V(far, far, far), 0.9)
            .AddPlane("left", V(1), V(far - 3)).AddPlane("right", V(-1), V(far + 3));
        for (int i = 0; i < 5; i++)
        {
            builder.AddBody(
                $"ball {i}", Ball(0.25, 1 + i, flight: i == 2 ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic), V(far - 2.25 + i, far + 1 + (i * i % 7 / 8.0), far),
                V((i - 2) * 0.75, 0.1 * i));
        }

        return new(
            "far-and-late", builder.Build(),
            CorpusWorld.Accepted([ExternalEvent.Teleport(start + SimDuration.FromSeconds(1.7), 1, 1, First, V(far, far + 5, far), V(1, 2))]), 6, 20, start);
    }

    /// <summary>Accelerations written in C#, of time, place and velocity, at several steps, with contacts on the steps.</summary>
    private static CorpusWorld Supplied() => World(
        "supplied",
        new SceneBuilder("supplied").AddPlane("floor", Vector3D.Up, V(0), 0.8).AddForce(Force.Supplied(new DragAndSpring())).AddForce(Force.Supplied(new Eddy()))
            .AddBody("spring", Ball(0.25, 2, 0.9, MotionLaw.RungeKutta4, force: 1), V(2, 3), V(0, 1, 3))
            .AddBody("eddy", Ball(0.25, 1, 0.9, MotionLaw.RungeKutta4, 0.0125, 2), V(-1, 4, 1), V(1))
            .AddBody("coarse", Ball(0.25, 1, 0.5, MotionLaw.RungeKutta4, 0.05, 2), V(-2, 1, -1))
            .AddBody("free", Ball(0.25, 1, 0.9), V(0.5, 4), V(0, -1)).Build(),
        6, ExternalEvent.Impulse(At(2.2), 1, 1, Second, V(0, 3, 1)),
        ExternalEvent.Spawn(At(3), 1, 2, Ball(0.3, 1, 0.7, MotionLaw.RungeKutta4, force: 1), V(3, 5, 1)));

    /// <summary>Every force of the library in one room, in closed form and under error control, and a law that a spawn leaves to the world.</summary>
    private static CorpusWorld Forces()
    {
        SceneBuilder builder = new SceneBuilder("forces").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.9).AddPlane("wall", V(1), V(-4), 0.8)
            .AddForce(Force.LinearDrag("oil", 0.3, V(0.5)), out ForceSet oil).AddForce(Force.QuadraticDrag("air", 0.02, V(0, 0, -1)), out ForceSet air)
            .AddForce(Force.Spring("spring", V(0, 4), 6, 0.1), out ForceSet spring).AddForce(Force.Magnetic("coil", V(0, 0.5, 2), 1.5), out ForceSet coil)
            .AddForce(Force.Central("well", V(2, 1), 3, -1), out ForceSet well);
        builder.AddBody("oily", new BodySpec(0.25, 1, 0.9, forces: oil), V(-3, 3), V(-1, 2))
            .AddBody("on a spring", new BodySpec(0.3, 2, 0.9, forces: spring | oil), V(0, 6), V(1, 0, 1))
            .AddBody("charged", new BodySpec(0.25, 0.5, 0.9, forces: coil, tolerance: 1e-6), V(2, 5), V(1))
            .AddBody("all of it", new BodySpec(0.25, 1, 0.8, forces: oil | coil | spring, tolerance: 1e-7), V(3, 4, 1), V(0, 0, -1))
            .AddBody("in the air", new BodySpec(0.25, 1, 0.9, forces: air), V(-2, 7, 0.1))
            .AddBody("fixed steps", new BodySpec(0.25, 1, 0.9, MotionLaw.DormandPrince54, SimDuration.FromSeconds(0.02), air | well, 0), V(-2, 5, 0))
            .AddBody("in the well", new BodySpec(0.25, 1, 0.9, forces: well | air, tolerance: 1e-6), V(3, 2), V(0, 0, 2))
            .AddBody("free", new BodySpec(0.25, 1, 0.9), V(1, 3), V(0, 1));
        return World(
            "forces", builder.Build(), 4, ExternalEvent.Impulse(At(1.3), 1, 1, First, V(0, 3, 1)), ExternalEvent.SetVelocity(At(1.7), 1, 2, BodyId.OfScene(4), V(3)),
            ExternalEvent.Spawn(At(2), 1, 3, new BodySpec(0.3, 1, 0.7, forces: air | coil), V(3, 5, 1)), ExternalEvent.Spawn(At(2.1), 2, 1, new BodySpec(0.3, 1, 0.7, forces: coil), V(-3, 5, 1)));
    }

    /// <summary>Friction and spin: slipping, rolling, turning, rest on a floor and across a slope, grips and slips of impacts, a curve ball.</summary>
    private static CorpusWorld Rough()
    {
        SceneBuilder builder = new SceneBuilder("rough").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.7, 0.6).AddPlane("slope", V(0.6, 0.8), V(-6), 0.3)
            .AddPlane("wall", V(-1), V(6), 0.8, 0.2).AddStaticSphere("stone", V(3, 0.2, 2), 0.5, 0.5).AddForce(Force.Magnus("air", 0.2), out ForceSet air);
        builder.AddBody("slips", new BodySpec(0.5, 2, 0.5, friction: 0.3), V(-1, 0.5), V(3, 0, 1), spin: V(0, 2, 9))
            .AddBody("stops", new BodySpec(0.25, 1, 0, friction: 0.5, rollingResistance: 0.05), V(2, 0.25, -2), V(1.5))
            .AddBody("across", new BodySpec(0.25, 1, 0.2, friction: 0.4, rollingResistance: 0.01), V(-4, 2.5, -1), V(0, 0, 2))
            .AddBody("strikes", new BodySpec(0.3, 0.5, 0.9, friction: 1), V(2.5, 3, 2), V(0.2, -1), spin: V(5, -3, 1))
            .AddBody("curves", new BodySpec(0.25, 1, 0.9, forces: air, friction: 0.2, tolerance: 1e-6), V(-3, 5, 3), V(3, 2, -2), spin: V(3, 8, -4))
            .AddBody("smooth", new BodySpec(0.3, 1, 0.8), V(1, 2.5, 0), V(-1))
            .AddBody("turns", new BodySpec(0.25, 1, 0, friction: 0.5, rollingResistance: 0.05), V(-1, 0.25, -4), spin: V(0, 6))
            .AddBody("turns on it", new BodySpec(0.25, 1, 0, friction: 0.5, rollingResistance: 0.05), V(-1, 0.75, -4), spin: V(0, -8));
        return World(
            "rough", builder.Build(), 5, ExternalEvent.Impulse(At(2.2), 1, 1, Second, V(1, 2, 0.5)), ExternalEvent.Teleport(At(3), 1, 2, Third, V(0, 4, 1), V(1)),
            ExternalEvent.Spawn(At(1.5), 2, 1, new BodySpec(0.3, 1, 0.6, friction: 0.7), V(0, 5, -1), V(1, 0, 2)));
    }

    /// <summary>Ellipses of every eccentricity and a hyperbola about one centre, with a collision on the way.</summary>
    private static CorpusWorld Orbits()
    {
        SceneBuilder builder = new SceneBuilder("orbits").WithGravity(Floating).AddForce(Force.Central("sun", V(1), 4), out ForceSet sun);
        double[] speeds = [2, 1.5, 0.6, 0.1, 3];
        for (int i = 0; i < speeds.Length; i++)
        {
            builder.AddBody($"planet {i}", new BodySpec(0.05, 1 + i, 1, forces: sun), V(2, i * 0.2), V(0, 0.1, speeds[i]));
        }

        builder.AddBody("against them", new BodySpec(0.05, 1, 1, forces: sun), V(2, 0, 1), V(0, 0.1, -1));
        return World("orbits", builder.Build(), 2, ExternalEvent.Impulse(At(0.7), 1, 1, First, V(0, 0.3, 0.1)));
    }

    /// <summary>All kinds of events of several players at equal ticks, at ticks of impacts, on bodies that are not there, and refused ones.</summary>
    private static CorpusWorld Ties()
    {
        Scene scene = new SceneBuilder("ties").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.9)
            .AddBody("left", Ball(e: 0.9), V(-1, 3)).AddBody("right", Ball(e: 0.9), V(1, 3)).Build();
        Simulation quiet = Run(scene, 3);
        SimTime impact = quiet.Timeline(First).First(entry => entry.Key.Kind == EventKind.Impact).Key.Time;
        BodyId spawned = new(2, 1, 0);
        ExternalEvent[] events =
        [
            ExternalEvent.Remove(At(1), 3, 1, spawned),
            ExternalEvent.Spawn(At(1), 2, 1, Ball(0.25, 2), V(0, 5), V(0, -1)),
            ExternalEvent.Teleport(At(1), 2, 2, spawned, V(0.25, 6)),
            ExternalEvent.Teleport(At(1), 1, 1, spawned, V(-0.25, 6)),
            ExternalEvent.SetVelocity(impact, 1, 2, First, V(1, 2)),
            ExternalEvent.Impulse(impact, 2, 3, First, V(0.5, 0, 0.125)),
            ExternalEvent.SetVelocity(impact + SimDuration.OneTick, 2, 4, Second, V(-1, 3)),
            ExternalEvent.Impulse(impact - SimDuration.OneTick, 3, 2, Second, V(0, -1)),
            ExternalEvent.Spawn(At(1.5), 3, 3, Ball(0.3, 0.1, 0.8), V(0, 7)),
            ExternalEvent.SetVelocity(At(1.25), 1, 3, new BodyId(3, 3, 0), V(9)),
            ExternalEvent.Impulse(At(1.5), 1, 4, new BodyId(3, 3, 0), V(0.1, 0.2)),
            ExternalEvent.Remove(At(2.5), 1, 5, First),
            ExternalEvent.Teleport(At(2.75), 2, 5, First, V(0, 9)),
            ExternalEvent.SetVelocity(At(0.5), 4, 1, Second, V(100)),
        ];
        LogEntry[] log = CorpusWorld.Accepted(events);
        log[^1] = new LogEntry(log[^1].Index, Verdict.TooLate, log[^1].Event);
        return new("ties", scene, log, 4, 20, SimTime.Zero);
    }

    /// <summary>Ten micrometres at a thousand kilometres a second.</summary>
    private static CorpusWorld SmallAndFast()
    {
        SceneBuilder builder = new SceneBuilder("small and fast").WithGravity(Floating).AddPlane("wall", V(1), V(0));
        foreach (MotionLaw flight in new[] { MotionLaw.Ballistic, MotionLaw.RungeKutta4 })
        {
            BodySpec bullet = Ball(1e-5, 1e-6, flight: flight, step: 1e-6);
            double y = flight == MotionLaw.Ballistic ? 0 : 3;
            builder.AddStaticSphere($"post {flight}", V(1 + 1e-4, y), 1e-4)
                .AddBody($"rattles {flight}", bullet, V(0.3, y), V(1e6)).AddBody($"left {flight}", bullet, V(0.2, y + 1), V(1e6, 10, 1))
                .AddBody($"right {flight}", bullet, V(2.6, y + 1), V(-1e6));
        }

        return World("small-and-fast", builder.Build(), 1e-5);
    }

    /// <summary>Places and speeds below the least normal double: a runtime that takes them for zero gives other bits.</summary>
    private static CorpusWorld Subnormal() => World(
        "subnormal",
        new SceneBuilder("subnormal").WithGravity(Floating).AddPlane("wall", V(1), V(-0.25))
            .AddBody("drifts", Ball(0.25), V(0), V(3e-310, -7e-309, 1e-322)).AddBody("steps", Ball(0.25, flight: MotionLaw.RungeKutta4, step: 0.05), V(0, 2), V(-5e-312, 0, 2e-308))
            .AddBody("heavy", Ball(0.25, 1e30), V(0, 4)).Build(),
        5, ExternalEvent.Impulse(At(1), 1, 1, Third, V(1e-285, -3e-292, 4e-294)), ExternalEvent.Impulse(At(2), 1, 2, Third, V(7e-291, 1e-293, 0)));

    /// <summary>A hundred events drawn by a seed, at few different times, on balls of both laws in a box with a slope.</summary>
    private static CorpusWorld ScriptedActions()
    {
        SeededRandom random = new(4);
        SceneBuilder builder = new SceneBuilder("deeds").WithSmallestRadius(0.25).AddPlane("floor", Vector3D.Up, V(0), 0.7).AddPlane("slope", V(-0.6, 0.8), V(2), 0.5)
            .AddPlane("west", V(1), V(-4), 0.9).AddPlane("north", V(0, 0, 1), V(0, 0, -3)).AddPlane("south", V(0, 0, -1), V(0, 0, 3), 0.8);
        List<BodyId> bodies = [];
        for (int i = 0; i < 8; i++)
        {
            builder.AddBody($"ball {i}", Spec(random), V(-3 + (i % 4), 2 + (i / 4 * 1.5), random.NextDouble(-1, 1)), V(0, 0, random.NextDouble(-2, 2)));
            bodies.Add(BodyId.OfScene(i));
        }

        uint[] sequences = new uint[4];
        List<ExternalEvent> events = [];
        for (int i = 0; i < 100; i++)
        {
            byte peer = (byte)Pick(random, 4);
            uint sequence = ++sequences[peer];
            SimTime time = At((1 + Pick(random, 47)) / 8.0);
            BodyId body = bodies[Pick(random, bodies.Count)];
            Vector3D place = V(random.NextDouble(-3, 1), random.NextDouble(2, 5), random.NextDouble(-2, 2));
            Vector3D speed = V(random.NextDouble(-4, 4), random.NextDouble(-4, 4), random.NextDouble(-4, 4));
            switch (Pick(random, 7))
            {
                case 0:
                    ExternalEvent spawn = ExternalEvent.Spawn(time, peer, sequence, Spec(random), place, speed);
                    bodies.Add(spawn.Body);
                    events.Add(spawn);
                    break;
                case 1:
                    events.Add(ExternalEvent.Remove(time, peer, sequence, body));
                    break;
                case 2 or 3:
                    events.Add(ExternalEvent.Teleport(time, peer, sequence, body, place, speed));
                    break;
                case 4 or 5:
                    events.Add(ExternalEvent.SetVelocity(time, peer, sequence, body, speed));
                    break;
                default:
                    events.Add(ExternalEvent.Impulse(time, peer, sequence, body, speed));
                    break;
            }
        }

        return World("deeds", builder.Build(), 6, [.. events]);
    }

    private static BodySpec Spec(SeededRandom random)
    {
        bool steps = Pick(random, 3) == 0;
        return Ball(
            random.NextDouble(0.25, 0.45), random.NextDouble(0.5, 20), random.NextDouble(0.4, 1), steps ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic,
            steps ? 0.0125 : 0);
    }

    private static int Pick(SeededRandom random, int count) => (int)(random.NextUInt64() % (ulong)count);
}
