using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What is in a hand: its path, what it does to others, whose it is, and how that ends.</summary>
public sealed class HeldTests
{
    [Fact]
    public void Path_OfRandomKeyframes_HasNoJumpAndConvergesOnWhatTheLastKeyframeForetells()
    {
        for (int seed = 0; seed < 60; seed++)
        {
            Random random = new(seed);
            Vector3D offset = V(0.1, random.NextDouble(), -0.2);
            List<ExternalEvent> events = [ExternalEvent.Grab(At(0.1), 1, 1, First, offset)];
            SimTime time = At(0.1);
            for (uint n = 0; n < 20; n++)
            {
                time += SimDuration.FromSeconds(random.NextDouble() * (n % 3 == 0 ? 0.4 : 0.06));
                events.Add(ExternalEvent.HoldKeyframe(time, 1, n + 2, First, Draw(random, 1), Draw(random, 3)));
            }

            ExternalEvent last = events[^1];
            Simulation simulation = Run(Lonely(), 8, events);
            TimelineEntry[] path = simulation.Timeline(First).ToArray();
            Assert.True(path.Length > 25, $"{path.Length}");
            foreach (TimelineEntry entry in path.Skip(2).Where(entry => entry.State.Motion == MotionLaw.Held))
            {
                BodyState before = Read(simulation, First, entry.Key.Time - SimDuration.OneTick);
                Near(before.Position, entry.State.Position, 1e-10); // a tick's way at 100 m/s
                Near(before.Velocity, entry.State.Velocity, 1e-6); // and a tick's change of speed
            }

            for (double s = 0.05; s < 1; s += 0.003)
            {
                SimDuration since = SimDuration.FromSeconds(s);
                BodyState state = Read(simulation, First, time + since);
                Near(HandPath.Position(last.Position, last.Velocity, since) - offset, state.Position, 1e-12);
                Near(HandPath.Velocity(last.Velocity, since), state.Velocity, 1e-11);
            }

            BodyState still = Read(simulation, First, time + SimDuration.FromSeconds(0.99));
            Assert.Equal((MotionLaw.Held, V(0)), (still.Motion, still.Velocity));
            Near(last.Position + (last.Velocity * 0.15) - offset, still.Position, 1e-12); // half of what it would go in 0.3 s
        }
    }

    [Fact]
    public void Path_OfATeleport_IsSeenToJump()
    {
        // The control of the test above.
        Simulation simulation = Run(Lonely(), 1, [ExternalEvent.Teleport(At(0.5), 1, 1, First, V(0, 0.001))]);
        Vector3D before = Read(simulation, First, At(0.5) - SimDuration.OneTick).Position;
        Assert.True((before - Read(simulation, First, At(0.5)).Position).Length > 1e-10);
    }

    [Fact]
    public void Path_OfAHandThatComesToRest_IsOneStillPieceAKeyframe()
    {
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0.1), 1, 1, First)];
        for (uint n = 1; n <= 10; n++)
        {
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 + (0.4 * n)), 1, n + 1, First, V(0.1, 0.7, 1e3), V(0)));
        }

        Simulation simulation = Run(Lonely(), 6, events);
        Assert.Equal(1 + 1 + 2 + 9 + 1, simulation.Timeline(First).Count); // there, held, once to where the hand is, a piece each, let go by itself
        Assert.Equal(MotionLaw.Held, Read(simulation, First, 5.09).Motion);
        Assert.Equal((MotionLaw.Ballistic, V(0)), (Read(simulation, First, At(5.1)).Motion, Read(simulation, First, At(5.1)).Velocity));
        Near(V(0.1, 0.7, 1e3), Read(simulation, First, At(5.1)).Position, 1e-9);
    }

    [Theory]
    [InlineData(0.0)]
    [InlineData(0.5)]
    [InlineData(1.0)]
    public void Impact_WithAFreeBall_IsThatOfAnInfiniteMassAndLeavesTheHandsPathAsItIs(double e)
    {
        // From 0.15 s on the path is x = 3 (s - s^2 / 0.6) exactly; the balls touch where that is 0.25.
        Scene scene = new SceneBuilder("strike").WithGravity(Floating).AddBody("held", Ball(0.5, 1e-3, e), V(0)).AddBody("free", Ball(0.5, 1e3, e), V(1.25)).Build();
        ExternalEvent[] events =
            [ExternalEvent.Grab(At(0.1), 1, 1, First, maxForce: 1e6), ExternalEvent.HoldKeyframe(At(0.1), 1, 2, First, V(0), V(3))]; // a ton
        Simulation simulation = Run(scene, 1, events);
        TimelineEntry impact = Assert.Single(Impacts(simulation, Second));
        double s = 0.3 - Math.Sqrt(0.09 - (0.25 * 0.6 / 3));
        Near(0.1 + s, impact.Key.Time.ToSeconds(), 1e-11);
        Near((1 + e) * 3 * (1 - (s / 0.3)), impact.State.Velocity.X, 1e-11);

        Simulation alone = Run(scene, 1, [.. events, ExternalEvent.Remove(At(0), 2, 1, Second)]);
        for (double t = 0; t <= 1; t += 0.01)
        {
            SameBits(Read(alone, First, t), Read(simulation, First, t));
        }
    }

    [Fact]
    public void Impact_WhileThePathConverges_IsWhereFineStepsFindIt()
    {
        int impacts = 0;
        for (int seed = 0; seed < 40; seed++)
        {
            Random random = new(seed);
            Scene scene = new SceneBuilder("cubic").AddBody("held", Ball(0.5, 1, 0.8), V(0)).AddBody("free", Ball(0.5, 1, 0.8), V(1.05, 0.3 * random.NextDouble()), V(-random.NextDouble())).Build();
            ExternalEvent[] events =
            [
                ExternalEvent.Grab(At(0.01), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.02), 1, 2, First, V(0.2, 0.1) + Draw(random, 0.1), Draw(random, 4)),
            ];
            Simulation simulation = Run(scene, 0.07, events);
            if (Impacts(simulation, Second).Count == 0 || Impacts(simulation, Second)[0].Key.Time < At(0.02))
            {
                continue;
            }

            // The paths of the two alone, and the first step of 50 ns after which they overlap.
            Simulation held = Run(scene, 0.07, [.. events, ExternalEvent.Remove(At(0), 2, 1, Second)]);
            Simulation free = Run(scene, 0.07, [ExternalEvent.Remove(At(0), 2, 1, First)]);
            double found = double.NaN;
            for (double t = 0.02; t < 0.07 && double.IsNaN(found); t += 5e-8)
            {
                found = (Read(held, First, t).Position - Read(free, Second, t).Position).Length <= 1 ? t : found;
            }

            Near(found, Impacts(simulation, Second)[0].Key.Time.ToSeconds(), 6e-8);
            impacts++;
        }

        Assert.True(impacts > 15, $"{impacts}");
    }

    [Fact]
    public void Hand_AndStaticGeometry_DoNotMindEachOtherAndWhatIsLetGoThereIsPutOut()
    {
        Scene scene = new SceneBuilder("through").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddPlane("wall", V(1), V(-3), 0.5).AddStaticSphere("stone", V(4, 0), 1, 0.5)
            .AddBody("ball", Ball(0.25, 1, 0.5), V(0, 0.25)).Build();
        foreach ((Vector3D to, Vector3D expected) in new[]
        {
            (V(0, -2), V(0, 0.25)), (V(-5, -2), V(-2.75, 0.25)), (V(4, 0.75), V(4, 1.25)), (V(4, -7), V(4, 1.25)), (V(0, 2), V(0, 2)),
        })
        {
            Simulation simulation = Run(scene, 2, [
                ExternalEvent.Grab(At(0.1), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.1), 1, 2, First, to, V(0)), ExternalEvent.Release(At(0.5), 1, 3, First)]);
            Near(to, Read(simulation, First, 0.4).Position, 1e-12);
            Near(expected, Read(simulation, First, At(0.5)).Position, 1e-9);
            Assert.True(simulation.EventsProcessed < 5_000, $"{simulation.EventsProcessed}");
        }
    }

    [Fact]
    public void Hands_ThatMeet_PassThroughEachOther()
    {
        Scene scene = new SceneBuilder("two").WithGravity(Floating).AddBody("one", Ball(), V(-2)).AddBody("other", Ball(), V(2)).Build();
        Simulation simulation = Run(scene, 1, [
            ExternalEvent.Grab(At(0.1), 1, 1, First), ExternalEvent.Grab(At(0.1), 2, 1, Second),
            ExternalEvent.HoldKeyframe(At(0.1), 1, 2, First, V(2, 0.1), V(0)), ExternalEvent.HoldKeyframe(At(0.1), 2, 2, Second, V(-2), V(0))]);
        Assert.Empty(Impacts(simulation, First));
        Near(V(2, 0.1), Read(simulation, First, 0.5).Position, 1e-12);
    }

    [Fact]
    public void Grab_OfWhatIsHeld_IsTheFirstsInCanonicalOrderWhoeverIsHeardFirst()
    {
        ExternalEvent one = ExternalEvent.Grab(At(0.5), 1, 1, First), two = ExternalEvent.Grab(At(0.5), 2, 1, First, V(0.1));
        foreach (ExternalEvent[] order in new ExternalEvent[][] { [one, two], [two, one] })
        {
            Simulation simulation = Run(Lonely(), 1, order);
            Assert.True(simulation.TryReadHold(First, At(0.7), out Hold hold));
            Assert.Equal(new Hold(1, V(0), At(0.5)), hold);

            // Late events: that the first never was, or had let go before.
            simulation.Retract(one);
            simulation.AdvanceTo(At(1));
            Assert.True(simulation.TryReadHold(First, At(0.7), out hold));
            Assert.Equal(new Hold(2, V(0.1), At(0.5)), hold);
            Assert.Equal(Run(Lonely(), 1, [two]).StateHash(At(1)), simulation.StateHash(At(1)));
        }

        Assert.False(Run(Lonely(), 1, []).TryReadHold(First, At(0.7), out _));
    }

    [Fact]
    public void Actions_OfThoseWhoDoNotHold_HaveNoEffect()
    {
        ExternalEvent[] hold = [ExternalEvent.Grab(At(0.25), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.3), 1, 2, First, V(1), V(1, 2))];
        Simulation expected = Run(Lonely(), 1.25, hold);
        ExternalEvent[] vain =
        [
            ExternalEvent.HoldKeyframe(At(0.1), 2, 1, First, V(5), V(5)), ExternalEvent.Release(At(0.1), 1, 11, First, V(7)), ExternalEvent.HoldKeyframe(At(0.4), 2, 3, First, V(5), V(5)),
            ExternalEvent.Release(At(0.4), 2, 4, First, V(7)), ExternalEvent.Grab(At(0.4), 2, 5, First), ExternalEvent.Grab(At(0.5), 1, 12, First, V(9)),
            ExternalEvent.Impulse(At(0.6), 2, 6, First, V(9)), ExternalEvent.SetVelocity(At(0.6), 0, 1, First, V(9)), ExternalEvent.Teleport(At(0.6), 1, 13, First, V(9)),
        ];
        Simulation actual = Run(Lonely(), 1.25, [.. hold, .. vain]);
        for (double t = 0; t <= 1.25; t += 0.05)
        {
            Assert.Equal(expected.StateHash(At(t)), actual.StateHash(At(t)));
        }

        Assert.Equal(expected.EventHash(At(1.25)), actual.EventHash(At(1.25)));
        foreach (ExternalEvent one in vain)
        {
            // The control: of a body that is not held, or of who holds it, each of them has one.
            ExternalEvent own = one.Kind switch
            {
                EventKind.HoldKeyframe => ExternalEvent.HoldKeyframe(At(0.4), 1, 99, First, one.Position, one.Velocity),
                EventKind.Release => ExternalEvent.Release(At(0.4), 1, 99, First, one.Velocity),
                _ => one.At(At(0.2)),
            };
            Assert.NotEqual(expected.EventHash(At(1)), Run(Lonely(), 1.25, [.. hold, own]).EventHash(At(1)));
        }
    }

    [Fact]
    public void Remove_OfWhatIsHeld_EndsTheHold()
    {
        Simulation simulation = Run(Lonely(), 1, [
            ExternalEvent.Grab(At(0.25), 1, 1, First), ExternalEvent.Remove(At(0.5), 2, 1, First), ExternalEvent.HoldKeyframe(At(0.6), 1, 2, First, V(1), V(1))]);
        Assert.False(simulation.TryReadHold(First, At(0.5), out _));
        Assert.Equal(MotionLaw.Absent, Read(simulation, First, 1).Motion);
        Assert.True(simulation.TryReadHold(First, At(0.5) - SimDuration.OneTick, out _));
    }

    [Fact]
    public void Release_WithAVelocity_IsAFreeBodyAtThatInstant()
    {
        Simulation simulation = Run(Lonely(), 1, [ExternalEvent.Grab(At(0.25), 1, 1, First), ExternalEvent.Release(At(0.5), 1, 2, First, V(1, 2, 3))]);
        Assert.Equal((MotionLaw.Ballistic, V(1, 2, 3)), (Read(simulation, First, At(0.5)).Motion, Read(simulation, First, At(0.5)).Velocity));
        Assert.False(simulation.TryReadHold(First, At(0.5), out _));
    }

    [Fact]
    public void Hand_FasterThanMayBeGiven_IsNotFollowed()
    {
        Scene scene = new SceneBuilder("slow").WithGravity(Floating).WithSmallestRadius(1e-9).AddBody("ball", Ball(1e-9), V(0)).Build(); // at most 110 m/s
        Simulation simulation = Run(scene, 1, [
            ExternalEvent.Grab(At(0.1), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.2), 1, 2, First, V(1.5), V(0)), ExternalEvent.HoldKeyframe(At(0.4), 1, 3, First, V(30), V(0))]);
        Near(V(1.5), Read(simulation, First, 1).Position, 1e-12);
        Assert.True(simulation.TryReadHold(First, At(0.9), out Hold hold));
        Assert.Equal(At(0.2), hold.KeyframeTime);
        Assert.Contains("at most", Assert.Throws<SceneException>(() => simulation.Submit(ExternalEvent.HoldKeyframe(At(1), 1, 4, First, V(3), V(200)))).Message, StringComparison.Ordinal);
        Assert.Contains("position", Assert.Throws<SceneException>(() => simulation.Submit(ExternalEvent.Grab(At(1), 1, 4, First, V(double.NaN)))).Message, StringComparison.Ordinal);
        Assert.Contains("velocity", Assert.Throws<SceneException>(() => simulation.Submit(ExternalEvent.Release(At(1), 1, 4, First, V(1e300)))).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void SubmitForwarded_OfAHand_IsDoneAtTheArrivalAsItIs()
    {
        Simulation simulation = new(Lonely(), KeepAll);
        simulation.AdvanceTo(At(0.5));
        simulation.SubmitForwarded(ExternalEvent.Grab(At(0.25), 1, 1, First), At(0.5));
        simulation.SubmitForwarded(ExternalEvent.HoldKeyframe(At(0.3), 1, 2, First, V(1), V(1)), At(0.55));
        simulation.SubmitForwarded(ExternalEvent.Impulse(At(0.3), 2, 1, First, V(1)), At(0.6)); // in a hand it has no effect
        simulation.AdvanceTo(At(1));
        Simulation expected = Run(Lonely(), 1, [ExternalEvent.Grab(At(0.5), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.55), 1, 2, First, V(1), V(1))]);
        Assert.Equal(expected.StateHash(At(1)), simulation.StateHash(At(1)));
    }

    [Fact]
    public void Snapshot_WithAHoldThatCannotBe_IsRefusedByName()
    {
        Simulation world = Run(Lonely(), 1, [ExternalEvent.Grab(At(0.25), 1, 1, First), ExternalEvent.HoldKeyframe(At(0.4), 1, 2, First, V(1), V(1))]);
        WorldSnapshot good = world.Snapshot(At(0.42));
        BodySnapshot b = good.Bodies[0];
        Assert.Equal((MotionLaw.Held, new Hold(1, V(0), At(0.4))), (b.Law, b.Hold));
        Assert.Equal(world.StateHash(At(0.42)), new Simulation(world.Scene, good).StateHash(At(0.42)));
        foreach (Hold bad in new[] { default, new Hold(1, V(0), At(0.39)), new Hold(1, V(0), At(0.41)), new Hold(1, V(2e12), At(0.4)), new Hold(1, V(0), SimTime.MinValue) })
        {
            BodySnapshot other = new(b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, default, b.Cubic, default, default, bad);
            Assert.Contains("hand", Assert.Throws<SceneException>(() => new Simulation(world.Scene, new WorldSnapshot(good.Start, good.Time, 0, [other]))).Message, StringComparison.Ordinal);
        }
    }

    private static Vector3D Draw(Random random, double most) => V(
        ((random.NextDouble() * 2) - 1) * most, ((random.NextDouble() * 2) - 1) * most, ((random.NextDouble() * 2) - 1) * most);

    private static Scene Lonely() => new SceneBuilder("lonely").WithGravity(Floating).AddBody("ball", Ball(), V(0)).Build();
}
