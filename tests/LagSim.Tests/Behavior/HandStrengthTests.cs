using System;
using System.Linq;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>A hand has a greatest force and power: in any time t it gives no more than in t, a blow and a step, whatever it presses or strikes.</summary>
public sealed class HandStrengthTests
{
    private const double Tolerance = 1e-3;

    /// <summary>The most that a hand gives in so long, in parts of its force or its power.</summary>
    private static double MostSeconds(double seconds) => seconds + HandPath.Settles.ToSeconds() + (1.0 / 64);

    /// <summary>Seven balls that fill a room, kicks, and a hand that keeps still, which threw one of them at 6.5e14 m/s once.</summary>
    [Fact]
    public void JammedRoom_WithAHand_GoesOn()
    {
        Assert.InRange(Fastest(JammedRoom(SolverRules.Usual), 1), 0.1, 20);
    }

    /// <summary>A hand that says a force pushes a ball, in front of it or at a distance, with no more: even if it moves faster than that allows.</summary>
    [Theory]
    [InlineData(0, 10, 0)]
    [InlineData(0.1, 10, 0)]
    [InlineData(0, 100, 20)]
    [InlineData(0.1, 100, 20)]
    [InlineData(0.1, 3, 3)]
    public void Push_IsNoStrongerThanTheHand(double gap, double force, double power)
    {
        foreach (double e in new[] { 0, 0.5, 1 })
        {
            (double speed, _) = Pushed(gap, e, force, power, SolverRules.Usual);
            double seconds = MostSeconds(0.4);
            double most = power > 0 ? Math.Min(force * seconds, Math.Sqrt(2 * power * seconds)) : force * seconds;
            Assert.InRange(speed, 0.01, most);
            Assert.True(Pushed(gap, e, force, power, new FaultySolverRules { HasUnboundedHands = true }).Speed > Math.Min(most, 5), "the control");
        }
    }

    /// <summary>By default a hand does what one without a bound does, to what is as heavy as what it holds.</summary>
    [Theory]
    [InlineData(0, 0)]
    [InlineData(0.1, 0.5)]
    [InlineData(0.1, 1)]
    public void Push_OfAHandThatSaysNothing_IsAsItWas(double gap, double e)
    {
        (double speed, BodyState ball) = Pushed(gap, e, 0, 0, SolverRules.Usual);
        Assert.True(speed > 4, $"{speed}");
        SameBits(Pushed(gap, e, 0, 0, new FaultySolverRules { HasUnboundedHands = true }).Ball, ball);
    }

    /// <summary>A ball that loses nothing, between a hand and a wall: without a bound each bounce of less and less room makes it faster.</summary>
    [Fact]
    public void Ball_BetweenAHandAndAWall_GetsNoMoreThanTheHandsPower()
    {
        double bounded = Fastest(Squeezed(SolverRules.Usual), 0.5);
        double most = Math.Sqrt(2 * 20 * MostSeconds(0.5)) + 5;
        Assert.InRange(bounded, 2, most);
        double unbounded = Fastest(Squeezed(new FaultySolverRules { HasUnboundedHands = true }), 0.5);
        Assert.True(unbounded > 2 * most, $"{unbounded}");
    }

    /// <summary>
    /// What a hand has given lately is on its path: a copy made then goes on to the same bits, as does a world that hears of the hand late.
    /// </summary>
    [Fact]
    public void Copy_OfAHandThatIsBusy_GoesOnTheSame()
    {
        Simulation all = Squeezed(SolverRules.Usual);
        all.AdvanceTo(At(0.5));
        int busy = 0;
        for (double t = 0.2; t < 0.45; t += 0.007)
        {
            Simulation original = Squeezed(SolverRules.Usual);
            original.AdvanceTo(At(t));
            WorldSnapshot snapshot = original.Snapshot(At(t));
            busy += snapshot.Bodies.Count(b => b.Hold.BusyUntil != default);
            Simulation copy = new(original.Scene, snapshot);
            SubmitHand(copy, SqueezeFrom, after: t);
            copy.AdvanceTo(At(0.5));
            SameBits(Read(all, First, 0.5), Read(copy, First, 0.5));
        }

        Assert.True(busy > 3, $"{busy}");
        Simulation late = new(all.Scene, KeepAll);
        late.AdvanceTo(At(0.5));
        SubmitHand(late, SqueezeFrom);
        late.AdvanceTo(At(0.5));
        SameBits(Read(all, First, 0.5), Read(late, First, 0.5));
        Assert.Equal(all.StateHash(At(0.5)), late.StateHash(At(0.5)));
    }

    /// <summary>All contacts of a hand together get no more than it may give in a step, and its island no more energy than it gives.</summary>
    [Theory]
    [InlineData(0.3)]
    [InlineData(3)]
    [InlineData(30)]
    public void Step_OfAHandAmongMany_GivesNoMoreThanItMay(double speed)
    {
        ContactStep step = Pile(speed, out int held, new FaultySolverRules { HasTirelessHands = true }); // the bound alone, not what gives way
        double seconds = step.Scale.Step.ToSeconds();
        double room = seconds * 40;
        Assert.True(ContactSolver.GivenBy(step.Problem, held) > room, "the control");
        Pile(speed, out held, SolverRules.Usual, room, out step);
        step.LimitEnergy(seconds, 1e-9);
        Assert.InRange(ContactSolver.GivenBy(step.Problem, held), 0, room * (1 + 1e-9));
        Assert.InRange(step.Problem.HandWork(), 0, room * speed);
        double fall = 9.81 * seconds;
        Assert.InRange(step.Problem.KineticEnergy(), 0, ((10 * fall * fall) + step.Problem.HandWork()) * (1 + 1e-9));
    }

    private static ContactStep Pile(double speed, out int held, SolverRules rules)
    {
        Pile(speed, out held, rules, double.PositiveInfinity, out ContactStep step);
        return step;
    }

    /// <summary>A hand that strikes down into the middle of a heap in a pit.</summary>
    private static void Pile(double speed, out int held, SolverRules rules, double room, out ContactStep step)
    {
        Scene pit = new SceneBuilder("pit").WithSmallestRadius(0.1).WithContactTolerance(Tolerance)
            .AddPlane("floor", Vector3D.Up, V(0), 0, 1).AddPlane("west", V(1), V(0), 0, 1).AddPlane("east", V(-1), V(1), 0, 1).Build();
        step = new ContactStep(pit, new ContactScale(Tolerance, V(0, -9.81), default), rules);
        double seconds = step.Scale.Step.ToSeconds();
        BodySpec ball = new(0.1, 1, 0, friction: 1);
        for (int n = 0; n < 10; n++)
        {
            step.AddBody(ball, V(0.1 + (0.2 * (n % 5)), 0.1 + (0.1999 * (n / 5))), V(0), V(0, -9.81) * seconds, V(0), isHeld: false);
        }

        held = step.Problem.BodyCount;
        step.AddBody(ball, V(0.4, 0.1 + 0.1999 + 0.173), V(0, -speed), V(0), V(0), isHeld: true);
        step.Problem.HandRoom(held) = room;
        step.FindContacts(seconds);
        step.Solve(seconds, 1e-9);
    }

    private static double Fastest(Simulation simulation, double until)
    {
        double fastest = 0;
        for (double t = 0; t <= until; t += 1.0 / 256)
        {
            simulation.AdvanceTo(At(t));
            for (int i = 0; i < simulation.BodyCount; i++)
            {
                BodyId body = simulation.BodyAt(i);
                bool isHeld = simulation.TryReadHold(body, At(t), out _);
                fastest = !isHeld && simulation.TryRead(body, At(t), out BodyState state) ? Math.Max(fastest, state.Velocity.Length) : fastest;
            }
        }

        return fastest;
    }

    /// <summary>A hand of this strength that moves at 5 m/s against a ball of 1 kg: how fast that gets.</summary>
    private static (double Speed, BodyState Ball) Pushed(double gap, double e, double force, double power, SolverRules rules)
    {
        Scene scene = new SceneBuilder("pushed").WithGravity(V(0)).AddBody("ball", Ball(0.25, 1, e), V(0.5 + gap)).AddBody("held", Ball(0.25, 1, e), V(0)).Build();
        Simulation simulation = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(10)).WithParts(new FaultyEngineParts { Rules = rules }));
        simulation.Submit(ExternalEvent.Grab(At(0), 1, 1, Second, maxForce: force, maxPower: power));
        for (uint n = 0; n < 10; n++)
        {
            simulation.Submit(ExternalEvent.HoldKeyframe(At(0.04 * n), 1, n + 2, Second, V(0.2 * n), V(5)));
        }

        return (Fastest(simulation, 0.4), Read(simulation, First, 0.4));
    }

    private const double SqueezeFrom = -2;

    private static Simulation Squeezed(SolverRules rules)
    {
        Scene scene = new SceneBuilder("squeezed").WithGravity(V(0)).AddPlane("wall", V(-1), V(0), 1)
            .AddBody("ball", Ball(0.25, 1, 1), V(-0.25), V(-2)).AddBody("held", Ball(0.25, 1, 1), V(SqueezeFrom)).Build();
        Simulation simulation = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(10)).WithParts(new FaultyEngineParts { Rules = rules }));
        SubmitHand(simulation, SqueezeFrom);
        return simulation;
    }

    private static void SubmitHand(Simulation simulation, double from, double after = -1)
    {
        for (uint n = 0; n < 12; n++)
        {
            ExternalEvent next = n == 0 ? ExternalEvent.Grab(At(0.01), 1, 1, Second, maxForce: 100, maxPower: 20)
                : ExternalEvent.HoldKeyframe(At(0.04 * n), 1, n + 1, Second, V(from + (0.04 * n * 4)), V(4));
            if (next.Time >= At(after))
            {
                simulation.Submit(next);
            }
        }
    }

    private static Simulation JammedRoom(SolverRules rules)
    {
        BodySpec ball = new(0.25, 1, 0.5, friction: 0.9272921640032893);
        const double e = 0.000556394264079052;
        Scene scene = new SceneBuilder("room").WithGravity(V(0, -8))
            .AddPlane("floor", V(0, 1), V(0), e).AddPlane("w1", V(1), V(-0.5), e).AddPlane("w2", V(-1), V(0.5), e)
            .AddPlane("w3", V(0, 0, 1), V(0, 0, -0.5), e).AddPlane("w4", V(0, 0, -1), V(0, 0, 0.5), e).AddPlane("roof", V(0, -1), V(0, 1), e)
            .AddBody("b0", ball, V(-0.25, 0.25, -0.25), V(0, 2)).AddBody("b1", ball, V(-0.25, 0.25, 0.25), V(2)).AddBody("b2", ball, V(-0.25, 0.75, -0.25), V(0, -2))
            .AddBody("b3", ball, V(0.25, 0.25, -0.25), V(-2)).AddBody("b4", ball, V(0.25, 0.25, 0.25), V(-2)).AddBody("b5", ball, V(0.25, 0.75, -0.25), V(0, 0, -2))
            .AddBody("b6", ball, V(0.25, 0.75, 0.25), V(2)).Build();
        Simulation room = new(scene, new SimulationOptions(history: SimDuration.FromSeconds(10)).WithParts(new FaultyEngineParts { Rules = rules }));
        Do(51539607552, 2, 5, PlayerAction.Impulse(BodyId.OfScene(0), V(-1.601786877867852, 2.8485142479784393, -0.8241947672898124)));
        Do(51539607552, 3, 19, PlayerAction.Impulse(BodyId.OfScene(2), V(1.2558358703609125, 1.6072108326394847, 2.0405831014114097)));
        Do(63372754551, 4, 2, PlayerAction.Teleport(BodyId.OfScene(2), V(0.25, 0.75, 0.25)));
        Do(63372754551, 3, 9, PlayerAction.Impulse(BodyId.OfScene(1), V(0.36574857909200187, -0.5552452705839261, -1.2179452415097156)));
        Do(137438953473, 2, 3, PlayerAction.Remove(BodyId.OfScene(4)));
        Do(240518168575, 4, 19, PlayerAction.Spawn(ball, V(0.25, 0.75, -0.25), V(1.5848608428286521, -2.4256959658993793, 0.6870075465588834), whenOccupied: WhenOccupied.Beside));
        Do(257698037759, 0, 25, PlayerAction.Grab(new BodyId(4, 19, 0), V(-0.035675008259948834, 0.09889812529458347, -0.08256211969326194)));
        return room;

        void Do(long ticks, byte peer, uint sequence, PlayerAction action) => room.Submit(action.Stamp(SimTime.FromTicks(ticks), peer, sequence));
    }
}
