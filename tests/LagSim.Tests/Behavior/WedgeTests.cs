using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Bodies without play: what any push drives into something that cannot give way must not cost an impact every microsecond.</summary>
public sealed class WedgeTests
{
    private const double Fine = 1e-7; // a contact tolerance, in metres

    private static readonly BodyId Third = BodyId.OfScene(2);

    [Fact]
    public void Wedged_UnderAHandThatKeepsStill_IsDone()
    {
        // Ball b lies between a wall, another and a dome, and the held ball on top leaves it no play: whatever impact it ends begins another.
        Scene scene = UnderAHand();
        ExternalEvent grab = ExternalEvent.Grab(At(0.25), 1, 1, Third, new Vector3D(0.0625, 0.0625, 0));
        Assert.True(IsDone(scene, [grab], 2, ignoresIslands: false, out Simulation inTime));
        Assert.False(IsDone(scene, [grab], 2, ignoresIslands: true, out _)); // the control: millions of events a second

        Simulation late = new(scene, KeepAll);
        late.AdvanceTo(At(0.6));
        late.Submit(grab);
        late.AdvanceTo(At(2));
        Assert.Equal(inTime.StateHash(At(2)), late.StateHash(At(2)));
        Assert.Equal(inTime.EventHash(At(2)), late.EventHash(At(2)));
    }

    [Fact]
    public void Wedged_BetweenStaticSurfaces_RestsUntilItIsMoved()
    {
        Scene scene = Notch();
        BodyId ball = BodyId.OfScene(0);
        Assert.True(IsDone(scene, [], 8, ignoresIslands: false, out Simulation simulation));
        Assert.False(IsDone(scene, [], 8, ignoresIslands: true, out _)); // the control
        Assert.Equal(MotionLaw.Resting, Read(simulation, ball, 8).Motion);
        Near(Read(simulation, ball, 2).Position, Read(simulation, ball, 8).Position, 1e-8);

        simulation.Submit(ExternalEvent.Impulse(At(7), 1, 1, ball, V(0, 300)));
        simulation.AdvanceTo(At(8));
        Assert.True(Read(simulation, ball, 7.2).Position.Y > 0.2, $"{Read(simulation, ball, 7.2).Position}");

        simulation.Submit(ExternalEvent.Grab(At(5), 1, 1, ball));
        simulation.Submit(ExternalEvent.HoldKeyframe(At(5.1), 1, 2, ball, V(0.3, 2, 0.3), V(0)));
        simulation.AdvanceTo(At(8));
        Near(V(0.3, 2, 0.3), Read(simulation, ball, 6).Position, 1e-9);
    }

    [Theory]
    [InlineData(0, MotionLaw.Resting)]
    [InlineData(1, MotionLaw.Constrained)] // what a program's own force will do nobody knows, so under one nothing rests
    public void Wedged_OfAnotherLaw_StaysAsWell(byte force, MotionLaw expected)
    {
        SceneBuilder builder = Slot(Ball(0.1027, 100, 0.157, MotionLaw.RungeKutta4, step: 0.01, force: force)).AddForce(Force.Supplied(new FunctionForce((_, _, v) => v * -0.1)));
        Assert.True(IsDone(builder.Build(), [], 4, ignoresIslands: false, out Simulation simulation));
        Assert.Equal(expected, Read(simulation, BodyId.OfScene(0), 4).Motion);
        Near(Read(simulation, BodyId.OfScene(0), 3).Position, Read(simulation, BodyId.OfScene(0), 4).Position, 1e-9);
    }

    [Theory]
    [InlineData(0.5)]
    [InlineData(1)]
    [InlineData(3)]
    public void Wedged_AtRest_GivesWayToAHandThatPushesItOut(double speed)
    {
        // The ball has come to stand after 0.7 s and sleeps half a second later, so before the hand sets out.
        const double from = 1.5, until = 4.5;
        Scene scene = Notch(withHand: true);
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0.01), 1, 1, BodyId.OfScene(1), maxForce: 1e5)]; // for 100 kg that it speeds up
        for (uint n = 0; n < 45; n++)
        {
            double up = speed * Math.Max(0, (0.1 * n) - from); // from below
            Vector3D place = new(0.1, -0.6 + up, 0.1);
            events.Add(ExternalEvent.HoldKeyframe(At(0.02 + (0.1 * n)), 1, n + 2, BodyId.OfScene(1), place, V(0, n > 15 ? speed : 0)));
        }

        Assert.True(IsDone(scene, events, until, ignoresIslands: false, out Simulation simulation));
        Assert.Equal(MotionLaw.Resting, Read(simulation, BodyId.OfScene(0), from).Motion);
        double highest = 0;
        for (double t = from; t <= until; t += 0.001)
        {
            Vector3D ball = Read(simulation, BodyId.OfScene(0), t).Position;
            Vector3D hand = Read(simulation, BodyId.OfScene(1), t).Position;

            // 2 d of a contact, and the hand speeds up by up to 60 m/s² here: in a step by so much more of d as that is more than gravity.
            Assert.True((ball - hand).Length > 0.1527 - ((2 + (60 / Gravity)) * Fine), $"the hand is in the ball at {t} s");
            highest = Math.Max(highest, ball.Y);
        }

        Assert.True(highest > 0.1, $"{highest} m");
    }

    [Fact]
    public void Pressed_AtRandom_IsDone()
    {
        for (int seed = 0; seed < 300; seed++)
        {
            (Scene scene, List<ExternalEvent> events) = Random(seed);
            Assert.True(IsDone(scene, events, 3, ignoresIslands: false, out Simulation simulation), $"seed {seed}, at {(simulation.SimulatedTo - simulation.Start).ToSeconds()} s");
        }
    }

    [Fact]
    public void Snapshot_OfWhatRestsWedged_GoesOnAsItDid()
    {
        Simulation world = new(Notch(), KeepAll);
        world.AdvanceTo(At(3));
        WorldSnapshot snapshot = world.Snapshot(At(2));
        BodySnapshot b = snapshot.Bodies[0];
        Assert.Equal((MotionLaw.Resting, 0), (b.Law, b.SupportCount));
        Simulation joined = new(world.Scene, snapshot, KeepAll);
        joined.AdvanceTo(At(3));
        Assert.Equal(world.StateHash(At(3)), joined.StateHash(At(3)));

        BodySnapshot forged = new(b.Id, b.Spec, b.Opened, b.Law, b.Epoch, At(2.5), b.Position, b.Velocity, b.Acceleration);
        Assert.Contains("The rest of", Assert.Throws<SceneException>(() => new Simulation(world.Scene, new WorldSnapshot(snapshot.Start, snapshot.Time, 0, [forged]))).Message, StringComparison.Ordinal);
    }

    private static bool IsDone(Scene scene, IEnumerable<ExternalEvent> events, double seconds, bool ignoresIslands, out Simulation simulation)
    {
        simulation = new Simulation(scene, KeepAll.WithParts(new FaultyEngineParts { IgnoresIslands = ignoresIslands }));
        foreach (ExternalEvent external in events)
        {
            simulation.Submit(external);
        }

        long budget = 100_000;
        return simulation.TryAdvanceTo(At(seconds), ref budget);
    }

    private static Scene UnderAHand() => new SceneBuilder("under a hand").WithSmallestRadius(0.125)
        .AddPlane("wall", V(1), V(0), 1).AddPlane("back", new Vector3D(0, 0, 1), V(0), 0.9).AddStaticSphere("dome", new Vector3D(1, -0.5, 0.5), 1, 0.7)
        .AddBody("a", Ball(0.25, 1, 0.3), new Vector3D(0.25, 2, 0.625), new Vector3D(-0.5, -1.5, -0.5))
        .AddBody("b", Ball(0.25, 1, 0.3), new Vector3D(0.25, 0.5, 0.5), new Vector3D(0.5, 0, 0.5))
        .AddBody("held", Ball(0.5, 1, 0.9), new Vector3D(0.75, 1.375, 0.875), new Vector3D(-1, -1, -0.5)).Build();

    /// <summary>A ball that falls between two walls and a dome, where it just fits: the dome's normal there is all but level.</summary>
    private static Scene Notch(bool withHand = false)
    {
        SceneBuilder builder = Slot(Ball(0.1027, 100, 0.157));
        return !withHand ? builder.Build()
            : builder.WithContactTolerance(Fine).AddBody("held", Ball(0.05, 1, 0.9), new Vector3D(0.1, -2, 0.1)).Build();
    }

    private static SceneBuilder Slot(BodySpec ball) => new SceneBuilder("notch").AddPlane("wall", V(1), V(0), 1).AddPlane("back", new Vector3D(0, 0, 1), V(0), 0.9)
        .AddStaticSphere("dome", new Vector3D(1, -0.5, 0.5), 1, 0.7).AddBody("ball", ball, new Vector3D(0.15, 1.1, 0.15), new Vector3D(0.1, 0, -0.1));

    /// <summary>One to three balls, some of them heavy, in a corner, on a floor or a dome or neither, and a hand that comes down on them, fast or slow, and then keeps still.</summary>
    private static (Scene Scene, List<ExternalEvent> Events) Random(int seed)
    {
        Random random = new(seed);
        SceneBuilder builder = new SceneBuilder("random").AddPlane("wall", V(1), V(0), 1).AddPlane("back", new Vector3D(0, 0, 1), V(0), 0.9);
        builder = random.Next(2) == 0 ? builder.AddPlane("floor", Vector3D.Up, V(0), 0.5) : builder;
        builder = random.Next(2) == 0 ? builder.AddStaticSphere("dome", new Vector3D(1, -0.5, 0.5), 1, 0.7) : builder;
        int balls = random.Next(1, 4);
        double y = 1;
        for (int i = 0; i < balls; i++)
        {
            double r = 0.1 + (0.2 * random.NextDouble());
            BodySpec spec = Ball(r, random.Next(2) == 0 ? 1 : 100, random.NextDouble());
            Vector3D place = new(r + (0.1 * random.NextDouble()), y + r, r + (0.1 * random.NextDouble()));
            builder.AddBody($"ball {i}", spec, place, new Vector3D(Draw(random, 0.5), Draw(random, 0.5), Draw(random, 0.5)));
            y += (2 * r) + 0.02;
        }

        Vector3D from = new(0.4, y + 0.5, 0.4);
        BodyId held = BodyId.OfScene(balls);
        Scene scene = builder.AddBody("held", Ball(0.4, 1, 0.9), from).Build();
        double speed = Math.Pow(10, -3 + (4 * random.NextDouble()));
        double depth = 0.2 + random.NextDouble();
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0.01), 1, 1, held)];
        for (uint k = 0; k < 60; k++)
        {
            double gone = Math.Min(depth, speed * k * 0.05);
            events.Add(ExternalEvent.HoldKeyframe(At(0.02 + (0.05 * k)), 1, k + 2, held, from - V(0, gone), V(0, gone < depth ? -speed : 0)));
        }

        return (scene, events);
    }

    private static double Draw(Random random, double most) => ((random.NextDouble() * 2) - 1) * most;
}
