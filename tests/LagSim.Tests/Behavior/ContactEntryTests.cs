using System;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// What a player gives a body in persistent contact, in the middle of a step, is followed as from the start of one: no act makes energy that it
/// does not give, and what is thrown moves as in free flight.
/// </summary>
public sealed class ContactEntryTests
{
    /// <summary>A toy balloon of 3 g that lies on a floor is thrown at it, at 30 to 990 m/s.</summary>
    [Fact]
    public void Throw_OfABalloonAtItsFloor_GainsNoSpeed()
    {
        Random random = new(3);
        int grew = 0;
        for (int n = 0; n < 60; n++)
        {
            double speed = 30 + (960 * random.NextDouble()), down = random.NextDouble() * 1.5;
            Vector3D velocity = V(speed * Math.Cos(down), -speed * Math.Sin(down));
            Assert.InRange(Fastest(velocity, null), 0, speed * (1 + 1e-9));
            grew += Grows(velocity, new FaultyEngineParts { FollowsChangesLate = true }) ? 1 : 0;
        }

        Assert.InRange(grew, 20, 60); // the control: what changes within a step is followed only from the next on
    }

    /// <summary>Along a floor without friction drag is all that acts, so the speed is that of the closed form, at any speed that a player may give.</summary>
    [Theory]
    [InlineData(0.43, 0.0107)]
    [InlineData(0.0027, 0.0005)]
    [InlineData(0.002, 0.16)]
    public void Push_AlongAFloor_SlowsDownAsInFreeFlight(double mass, double drag)
    {
        for (double speed = 30; speed <= 1e8; speed *= 10)
        {
            Scene scene = new SceneBuilder("pitch").AddForce(Force.QuadraticDrag("air", drag), out ForceSet air).AddPlane("floor", Vector3D.Up, Vector3D.Zero, friction: 0)
                .AddBody("ball", new BodySpec(0.11, mass, 0.8, forces: air), V(0, 0.11)).Build();
            Simulation world = Run(scene, 1.5, [ExternalEvent.SetVelocity(At(1.001), 1, 1, First, V(speed))]);
            BodyState ball = Read(world, First, 1.5);
            Assert.Equal(MotionLaw.Constrained, ball.Motion);
            double left = 1 / ((1 / speed) + (drag / mass * 0.499)); // of v' = -k v² / m
            double step = Math.Sqrt(2 * scene.ContactTolerance / Gravity); // the velocity is that of the middle of a step
            Assert.InRange(ball.Velocity.Length / left, 1 - (drag / mass * left * step) - 0.02, 1 + (drag / mass * left * step) + 0.02);
        }
    }

    /// <summary>A speed at which no step follows a body's drag is refused at the door.</summary>
    [Fact]
    public void Push_BeyondWhatAnyStepFollows_IsRefused()
    {
        Scene scene = new SceneBuilder("pitch").AddForce(Force.QuadraticDrag("air", 0.16), out ForceSet air).AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(0.11, 0.002, 0.8, forces: air), V(0, 0.11)).Build();
        Simulation world = Run(scene, 1);
        string refusal = Assert.Throws<SceneException>(() => world.Submit(ExternalEvent.SetVelocity(At(1), 1, 1, First, V(1e9)))).Message;
        Assert.Contains("'air'", refusal, StringComparison.Ordinal);
        Assert.Throws<SceneException>(() => world.Submit(ExternalEvent.Spawn(At(1), 1, 1, scene.Bodies[0].Spec, V(1, 1), V(1e9))));
        world.Submit(ExternalEvent.SetVelocity(At(1), 1, 1, First, V(1e8))); // the control
        world.AdvanceTo(At(1.1));
        Assert.Empty(world.LostBodies());
    }

    /// <summary>Two balls that a throw presses past each other part with no more energy than it gave.</summary>
    [Fact]
    public void Throw_IntoTheBallOnTop_PartsWithoutGain()
    {
        Assert.InRange(EnergyAfter(null), 0, 0.5 * 510 * 510);
        Assert.InRange(EnergyAfter(new FaultyEngineParts { Rules = new FaultySolverRules { GainsEnergy = true } }), 0.5 * 510 * 510 * 0.3, double.MaxValue); // the control
    }

    /// <summary>
    /// A throw into a ball cuts the step of that ball short, before its middle; the drag that follows from what it is given brakes it.
    /// </summary>
    [Fact]
    public void Throw_IntoABallWithDrag_DrivesNothing()
    {
        Vector3D thrown = V(-0.134, -0.236, -0.385);
        Assert.InRange(EnergyOfStackAfter(thrown, null), 0, 0.5 * thrown.LengthSquared);
        Assert.InRange(EnergyOfStackAfter(thrown, new FaultyEngineParts { Rules = new FaultySolverRules { ActsBackwards = true } }), thrown.LengthSquared, double.MaxValue); // the control
    }

    /// <summary>
    /// A throw onto a ball with drag, late in a step: what its drag owes for that step it gives at the velocity of that step, and not at the
    /// one that the throw gives it.
    /// </summary>
    [Fact]
    public void Throw_OntoABallWithDrag_GainsNothing()
    {
        double thrown = V(48.296, -25.882, 83.652).LengthSquared;
        Assert.InRange(MostAfterAThrowDown(null), 0, thrown);
        Assert.InRange(MostAfterAThrowDown(new FaultyEngineParts { Rules = new FaultySolverRules { GivesForcesLate = true } }), 100 * thrown, double.MaxValue); // the control
    }

    private static double MostAfterAThrowDown(FaultyEngineParts? parts)
    {
        Scene scene = new SceneBuilder("stack").AddForce(Force.QuadraticDrag("air", 1), out ForceSet air).AddPlane("floor", Vector3D.Up, V(0), 0.8)
            .AddBody("below", new BodySpec(0.15, 1e-3, 0.5, forces: air, friction: 0.5), V(0, 0.15))
            .AddBody("above", new BodySpec(0.15, 1e-3, 0.5, forces: air, friction: 0.5), V(0, 0.45)).Build();
        SimulationOptions options = new(history: SimDuration.MaxValue);
        Simulation world = new(scene, parts is null ? options : options.WithParts(parts));
        world.Submit(ExternalEvent.SetVelocity(At(0.1001), 1, 1, Second, V(48.296, -25.882, 83.652)));
        double most = 0;
        for (int n = 1; n <= 40; n++)
        {
            double time = 0.1001 + (n * 1e-7);
            world.AdvanceTo(At(time));
            most = Math.Max(most, Read(world, First, time).Velocity.LengthSquared + Read(world, Second, time).Velocity.LengthSquared);
        }

        return most;
    }

    /// <summary>In J a kg.</summary>
    private static double EnergyOfStackAfter(Vector3D thrown, FaultyEngineParts? parts)
    {
        Scene scene = new SceneBuilder("stack").WithContactTolerance(1.57e-3).AddForce(Force.QuadraticDrag("air", 29), out ForceSet air).AddPlane("floor", Vector3D.Up, V(0), friction: 0.825)
            .AddBody("below", new BodySpec(0.1, 1.2e-3, 0.886, forces: air, friction: 0.825), V(0, 0.1))
            .AddBody("above", new BodySpec(0.1, 1.2e-3, 0.886, forces: air, friction: 0.825), V(0, 0.3)).Build();
        SimulationOptions options = new(history: SimDuration.MaxValue);
        Simulation world = new(scene, parts is null ? options : options.WithParts(parts));
        world.Submit(ExternalEvent.SetVelocity(At(0.11424490862282255), 1, 1, Second, thrown));
        double most = 0;
        for (int n = 1; n <= 10; n++)
        {
            double time = 0.11424490862282255 + (n * 1e-6);
            world.AdvanceTo(At(time));
            most = Math.Max(most, 0.5 * (Read(world, First, time).Velocity.LengthSquared + Read(world, Second, time).Velocity.LengthSquared));
        }

        return most;
    }

    private static double EnergyAfter(FaultyEngineParts? parts)
    {
        Scene scene = new SceneBuilder("stack").WithContactTolerance(1e-3).AddPlane("floor", Vector3D.Up, V(0)).AddBody("below", new BodySpec(0.1, 1, 0), V(0, 0.1))
            .AddBody("above", new BodySpec(0.1, 1, 0), V(0, 0.3)).Build();
        SimulationOptions options = new(history: SimDuration.MaxValue);
        Simulation world = new(scene, parts is null ? options : options.WithParts(parts));
        world.Submit(ExternalEvent.SetVelocity(At(0.1), 1, 1, First, V(510 * Math.Cos(0.9), 510 * Math.Sin(0.9))));
        world.AdvanceTo(At(0.12));
        return 0.5 * (Read(world, First, 0.12).Velocity.LengthSquared + Read(world, Second, 0.12).Velocity.LengthSquared);
    }

    private static bool Grows(Vector3D velocity, FaultyEngineParts parts)
    {
        try
        {
            return Fastest(velocity, parts) > velocity.Length * 1.01;
        }
        catch (SimulationException)
        {
            return true;
        }
    }

    private static double Fastest(Vector3D velocity, FaultyEngineParts? parts)
    {
        Scene scene = new SceneBuilder("room").AddForce(Force.QuadraticDrag("air", 0.02), out ForceSet air).AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(0.15, 0.003, 0.3, forces: air), V(0, 0.15)).Build();
        SimulationOptions options = new(history: SimDuration.MaxValue);
        Simulation world = new(scene, parts is null ? options : options.WithParts(parts));
        world.Submit(ExternalEvent.SetVelocity(At(0.011), 1, 1, First, velocity));
        long events = 20_000;
        world.TryAdvanceTo(At(0.1), ref events);
        return world.LostBodies().Count > 0 ? double.PositiveInfinity : world.Timeline(First).Max(entry => entry.State.Velocity.Length);
    }
}
