using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>What hands press on something, jam or carry: where it goes, at a bounded cost.</summary>
public sealed class PressedTests
{
    [Theory]
    [InlineData(1, 0.0)]
    [InlineData(1, 1.0)]
    [InlineData(3, 0.5)]
    [InlineData(2, 0.9)]
    public void Pressed_AgainstWhatCannotGiveWay_LetsTheHandThroughAtABoundedCost(int balls, double e)
    {
        // A row, exactly between the hand and a wall, on a floor without friction; and the same without a wall, which the hand just pushes along.
        foreach (bool wall in new[] { true, false })
        {
            SceneBuilder builder = new SceneBuilder("pressed").AddPlane("floor", Vector3D.Up, V(0), e);
            if (wall)
            {
                builder.AddPlane("wall", V(-1), V(0), e);
            }

            for (int i = 0; i < balls; i++)
            {
                builder.AddBody($"ball {i}", Ball(0.25, 1 + i, e), V(-0.25 - (0.5 * i), 0.25));
            }

            BodyId held = BodyId.OfScene(balls);
            Scene scene = builder.AddBody("held", Ball(0.25, 1, e), V(-1 - (0.5 * balls), 0.25)).Build();
            List<ExternalEvent> events = [ExternalEvent.Grab(At(0.1), 1, 1, held)];
            for (uint n = 0; n < 20; n++)
            {
                events.Add(ExternalEvent.HoldKeyframe(At(0.1 + (0.1 * n)), 1, n + 2, held, V(-1 - (0.5 * balls) + (0.2 * n), 0.25), V(2)));
            }

            Simulation simulation = Run(scene, 2.1, events);
            Assert.InRange(simulation.EventsProcessed, 20, (2.1 * Tolerance.StepsASecond(scene.ContactTolerance)) + 250); // steps of an island, and impacts
            for (int i = 0; i < balls; i++)
            {
                BodyState state = Read(simulation, BodyId.OfScene(i), 2.1);
                Assert.True(state.Position.Y > 0.2 && (!wall || state.Position.X < -0.2), $"{state.Position}"); // nothing was pressed into a plane
                Assert.True(state.Velocity.Length < 40, $"{state.Velocity}");
            }
        }
    }

    [Theory]
    [InlineData(1e-9)]
    [InlineData(1e-7)]
    [InlineData(1e-6)]
    [InlineData(3e-5)]
    [InlineData(1e-3)]
    public void Pressed_ByAHandThatCreeps_CostsNoMore(double speed)
    {
        Scene scene = new SceneBuilder("creeps").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddBody("below", Ball(0.25, 1, 0.5), V(0, 0.25)).AddBody("held", Ball(0.25, 1, 0.5), V(0, 0.75)).Build();
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0), 1, 1, Second)];
        for (uint n = 0; n < 20; n++)
        {
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 1, n + 2, Second, V(0, 0.75 - (speed * 0.1 * n)), V(0, -speed)));
        }

        Simulation simulation = Run(scene, 2, events);
        Assert.InRange(simulation.EventsProcessed, 20, 100_000);
        Near(V(0, 0.25), Read(simulation, First, 2).Position, 1e-6);
    }

    [Theory]
    [InlineData(3)]
    [InlineData(70)]
    public void Pressed_IntoACorner_CostsAsMuchAsOneStroke(double speed)
    {
        // Two balls in a corner, and a hand that presses the upper one on the lower and on the wall at once: whatever parts the two there closes it elsewhere.
        Scene scene = new SceneBuilder("corner").AddPlane("floor", Vector3D.Up, V(0), 0.9).AddPlane("wall", V(1), V(0), 0.9)
            .AddBody("lower", Ball(0.2, 1, 1), V(0.2, 0.2)).AddBody("upper", Ball(0.3, 0.5, 0.9), V(0.3, 0.69))
            .AddBody("held", Ball(0.2, 1, 1), V(1, 1.2)).Build();
        Vector3D way = V(-0.81, -0.586);
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0.1), 1, 1, Third)];
        for (uint n = 0; n < 8; n++)
        {
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 + (0.05 * n)), 1, n + 2, Third, V(1, 1.2) + (way * Math.Min(1.2, speed * 0.05 * n)), way * speed));
        }

        Assert.True(IsDone(ignoresIslands: false));
        Assert.True(speed > 10 || !IsDone(ignoresIslands: true)); // the control, but for a hand that is through before it costs much: thousands of events a millisecond

        bool IsDone(bool ignoresIslands)
        {
            FaultyEngineParts parts = new() { IgnoresIslands = ignoresIslands };
            Simulation simulation = new(scene, new SimulationOptions().WithParts(parts));
            events.ForEach(e => simulation.Submit(e));
            long budget = 3_000;
            return simulation.TryAdvanceTo(At(1), ref budget);
        }
    }

    /// <summary>
    /// A ball that rolls, or is pushed, into the gap between a slope and a still hand above it jams there by friction: no impact, however small, parts it from both. It
    /// stays where the friction of both holds it, and is let through where that of the hand does not; a hand of any force holds it there too.
    /// </summary>
    [Theory]
    [InlineData(0.3, 1, false)]
    [InlineData(0.3, 0.2, true)]
    [InlineData(1, 1, false)]
    public void Jammed_ByFrictionBetweenASlopeAndAHand_StaysOrIsLetThrough(double friction, double handFriction, bool passes)
    {
        Vector3D normal = V(-0.6, 0.8), down = V(-0.8, -0.6), lid = (normal * 0.998) + (down * Math.Sqrt(1 - (0.998 * 0.998)));
        Scene scene = new SceneBuilder("jam").AddPlane("slope", normal, 0.0, 0)
            .AddBody("ball", new BodySpec(0.5, 1, 0, friction: friction), normal * 0.5, V(0, 0, 0.01))
            .AddBody("held", new BodySpec(0.5, 1, 0, friction: handFriction), (normal * 0.5) + (lid * 1.00001)).Build();
        Assert.Equal(passes, Passes(pressesOn: false));
        Assert.False(Passes(pressesOn: true)); // the control

        bool Passes(bool pressesOn)
        {
            FaultyEngineParts parts = new() { Rules = new FaultySolverRules { HasTirelessHands = pressesOn } };
            Simulation simulation = new(scene, new SimulationOptions().WithParts(parts));
            for (uint n = 0; n < 10; n++)
            {
                simulation.Submit(n == 0 ? ExternalEvent.Grab(At(0), 1, 1, Second)
                    : ExternalEvent.HoldKeyframe(At(0.1 * n), 1, n + 1, Second, (normal * 0.5) + (lid * 1.00001), V(0)));
            }

            long budget = 5_000;
            Assert.True(simulation.TryAdvanceTo(At(1), ref budget));
            return (Read(simulation, First, 1).Position - (normal * 0.5)).Length > 0.1;
        }
    }

    [Fact]
    public void Pressed_BetweenTwoHandsOrOnTheFloor_StaysOfThisWorld()
    {
        Scene scene = new SceneBuilder("between").AddPlane("floor", Vector3D.Up, V(0), 0.5)
            .AddBody("left", Ball(0.25, 1, 0.9), V(-1, 3)).AddBody("middle", Ball(0.25, 1, 0.9), V(0, 3)).AddBody("right", Ball(0.25, 1, 0.9), V(1, 3))
            .AddBody("below", Ball(0.25, 1, 0.5), V(5, 0.25, 20)).AddBody("above", Ball(0.25, 1, 0.5), V(5, 1.25, 20)).Build();
        BodyId below = BodyId.OfScene(3), above = BodyId.OfScene(4);
        List<ExternalEvent> events = [ExternalEvent.Grab(At(0), 1, 1, First), ExternalEvent.Grab(At(0), 2, 1, Third), ExternalEvent.Grab(At(0), 3, 1, above)];
        for (uint n = 0; n < 10; n++)
        {
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 1, n + 2, First, V(-1 + (0.1 * n), 3 - (0.5 * 9.81 * 0.01 * n * n)), V(1, -0.981 * n)));
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 2, n + 2, Third, V(1 - (0.1 * n), 3 - (0.5 * 9.81 * 0.01 * n * n)), V(-1, -0.981 * n)));
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 3, n + 2, above, V(5, 1.25 - (0.1 * n), 20), V(0, -1)));
        }

        Simulation simulation = Run(scene, 1.5, events);
        Assert.InRange(simulation.EventsProcessed, 30, 500);
        foreach (double t in new[] { 0.5, 0.7, 0.9, 1.2, 1.5 })
        {
            // Straight below it cannot get out; a hand that stays in it below its centre lifts it off, slowly.
            BodyState pressed = Read(simulation, below, t);
            Near(V(5, 0, 20), pressed.Position - V(0, pressed.Position.Y), 1e-3);
            Assert.InRange(pressed.Position.Y, 0.249, t < 1 ? 0.251 : 0.5);
            Assert.InRange(Read(simulation, Second, t).Velocity.Length, 0, 60);
        }
    }

    [Fact]
    public void Carried_ByThreeHands_ABallGoesAlong()
    {
        SceneBuilder builder = new("cup");
        Vector3D[] cup = [V(0, 0, 0.6), V(0.52, 0, -0.3), V(-0.52, 0, -0.3)];
        for (int i = 0; i < cup.Length; i++)
        {
            builder.AddBody($"finger {i}", Ball(0.5, 1, 0.3), cup[i]);
        }

        BodyId carried = BodyId.OfScene(3);
        Scene scene = builder.AddBody("carried", Ball(0.5, 1, 0.3), V(0, 0.85)).Build();
        List<ExternalEvent> events = [];
        for (int i = 0; i < cup.Length; i++)
        {
            events.Add(ExternalEvent.Grab(At(0), 1, (uint)(100 * i) + 1, BodyId.OfScene(i)));
            for (uint n = 1; n < 20; n++)
            {
                double up = n < 5 ? 0 : 0.1 * (n - 5);
                events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 1, (uint)(100 * i) + n + 1, BodyId.OfScene(i), cup[i] + V(0.1 * up, up), n < 5 ? V(0) : V(0.1, 1)));
            }
        }

        Simulation simulation = Run(scene, 2, events);
        Vector3D finger = Read(simulation, First, 1.95).Position - cup[0];
        Assert.True(finger.Y > 1.3, $"{finger}");
        Vector3D ball = Read(simulation, carried, 1.95).Position - finger;
        Assert.InRange(ball.Y, 0.7, 1.0);
        Assert.True(Math.Abs(ball.X) < 0.1 && Math.Abs(ball.Z) < 0.1, $"{ball}");
        Assert.InRange(simulation.EventsProcessed, 100, 100_000);
    }

    [Fact]
    public void Heap_OnAHand_GoesOnWithinBounds()
    {
        SceneBuilder builder = new SceneBuilder("heap").AddPlane("west", V(1), V(-0.6), 0.3).AddPlane("east", V(-1), V(0.6), 0.3)
            .AddPlane("north", V(0, 0, 1), V(0, 0, -0.55), 0.3).AddPlane("south", V(0, 0, -1), V(0, 0, 0.55), 0.3).AddBody("hand", Ball(0.5, 1, 0.3), V(0));
        for (int i = 0; i < 4; i++)
        {
            builder.AddBody($"ball {i}", Ball(0.25, 1 + (3 * i), 0.3), V(0.3 * ((i % 2) - 0.5), 0.9 + (0.55 * i)));
        }

        List<ExternalEvent> events = [ExternalEvent.Grab(At(0), 1, 1, First)];
        for (uint n = 1; n < 15; n++)
        {
            events.Add(ExternalEvent.HoldKeyframe(At(0.1 * n), 1, n + 1, First, V(0.05 * (n % 2), 0.03 * n), V(0, 0.3)));
        }

        Simulation simulation = Run(builder.Build(), 1.5, events);
        Assert.InRange(simulation.EventsProcessed, 100, 150_000);
        Assert.True(MinGap(simulation, At(1.5)) > -0.3, $"{MinGap(simulation, At(1.5))}");
    }
}
