using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Rule 9 (docs/CONTACT.md): what leaves an island to slide, roll or rest alone on a plane touches it, and is neither above it nor in it.</summary>
public sealed class LandingTests
{
    private static readonly SolverRules InTheAir = new FaultySolverRules { LeavesInTheAir = true };

    /// <summary>
    /// A ball rolls off another, reaches the floor within a step, and does not rebound. Left where that step began, it would lie millimetres
    /// above the floor for ever.
    /// </summary>
    [Theory]
    [InlineData(1e-2, false)]
    [InlineData(1e-3, false)]
    [InlineData(1e-5, false)]
    [InlineData(1e-3, true)]
    [InlineData(1e-5, true)]
    public void BallThatRollsOffAnother_LiesOnTheFloor(double tolerance, bool leavesInTheAir)
    {
        BodySpec below = new(0.19, 1.6, 0, friction: 0.7, rollingResistance: 0.03), above = new(0.33, 1.2, 0, friction: 0.7, rollingResistance: 0.03);
        Scene scene = Floor(tolerance).AddBody("below", below, V(0, 0.19))
            .AddBody("above", above, V(0.48466032470295767, 0.3784260323278703), V(0.1)).Build();
        Simulation world = new(scene, KeepAll.WithParts(Parts(leavesInTheAir)));
        world.AdvanceTo(At(8));
        BodyState lies = Read(world, Second, 8);
        Assert.Equal(MotionLaw.Resting, lies.Motion);
        Assert.Equal(leavesInTheAir, Math.Abs(lies.Position.Y - 0.33) > tolerance);
        Assert.InRange(Math.Abs(lies.Position.Y - 0.33), 0, leavesInTheAir ? 0.02 : tolerance / 100);
    }

    /// <summary>Four balls of very different masses are put at one place, deep in a floor: the light ones leave it as they come out.</summary>
    [Theory]
    [InlineData(100, 1e-4, 1e-4)]
    [InlineData(1e4, 1e-4, 1e-6)]
    [InlineData(1e8, 1e-8, 1e-12)]
    public void BallsPutDeepIntoAFloor_AreOutOfIt(double heavy, double light, double lightest)
    {
        Assert.InRange(Deepest(heavy, light, lightest, leavesInTheAir: false), double.NegativeInfinity, 1e-3);
    }

    /// <summary>The control: what leaves where it is stays there, centimetres deep.</summary>
    [Fact]
    public void BallsPutDeepIntoAFloor_ThatLeaveWhereTheyAre_AreSeenInIt() =>
        Assert.InRange(Deepest(1e4, 1e-4, 1e-6, leavesInTheAir: true), 5e-3, 1);

    /// <summary>
    /// What is put into another, and parts from it faster than it would be pushed until a floor stops it there, is pushed out from then on:
    /// both are at rest then, and no impact would come. What does not collide with the other stays in it.
    /// </summary>
    [Theory]
    [InlineData(0.12, 5, true)]
    [InlineData(0.12, 100, true)]
    [InlineData(0.2, 20, true)]
    [InlineData(0.12, 5, false)]
    public void BallThatAFloorStopsInsideAnother_IsPushedOut(double height, double speed, bool collides)
    {
        CollisionFilter floorAlone = new(2, 1), other = collides ? default : new CollisionFilter(4, 1);
        Scene scene = Floor(1e-3).AddBody("thrown", new BodySpec(0.12, 3.6, 0, friction: 0.7, filter: collides ? default : floorAlone), V(3, 0.12))
            .AddBody("struck", new BodySpec(0.217, 1, 0, friction: 0.7, filter: other), V(0.03, 0.217)).Build();
        Simulation world = new(scene, KeepAll);
        world.Submit(PlayerAction.Teleport(First, V(0, height), V(0, -speed)).Stamp(At(1), 1, 1));
        world.AdvanceTo(At(3));
        double gap = (Read(world, First, 3).Position - Read(world, Second, 3).Position).Length - 0.337;
        Assert.InRange(gap, collides ? -1e-3 : -0.3, collides ? double.PositiveInfinity : -0.2);
    }

    private static double Deepest(double heavy, double light, double lightest, bool leavesInTheAir)
    {
        Simulation world = new(Floor(5e-4).Build(), KeepAll.WithParts(Parts(leavesInTheAir)));
        BodySpec[] specs =
        [
            new(0.237, heavy, 0, rollingResistance: 0.02), new(0.207, light, 1, friction: 0.463, rollingResistance: 0.02),
            new(0.0559, 0.0415, 0.719, friction: 0.112), new(0.249, lightest, 1, friction: 0.492),
        ];
        for (int n = 0; n < specs.Length; n++)
        {
            Vector3D velocity = n == 1 ? V(-0.755, 0.914, 0.268) : V(0);
            world.Submit(PlayerAction.Spawn(specs[n], V(0, 0.0565), velocity).Stamp(At(1), 1, (uint)n + 1));
        }

        world.AdvanceTo(At(8));
        double deepest = 0;
        for (int n = 0; n < specs.Length; n++)
        {
            deepest = Math.Max(deepest, world.SpecOf(world.BodyAt(n)).Radius - Read(world, world.BodyAt(n), 8).Position.Y);
        }

        return deepest;
    }

    private static FaultyEngineParts Parts(bool leavesInTheAir) => new() { Rules = leavesInTheAir ? InTheAir : SolverRules.Usual };

    private static SceneBuilder Floor(double tolerance) =>
        new SceneBuilder("floor").WithContactTolerance(tolerance).WithSmallestRadius(0.05).AddPlane("floor", Vector3D.Up, 0);
}
