using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Contact where forces, and not gravity, press; and what passes so fast that a step might hold it where it is not.</summary>
public sealed class ContactUnderForcesTests
{
    /// <summary>
    /// A pull to a point so far away that it is a weight: the same everywhere within these scenes, to a part in a million.
    /// </summary>
    private static Force Weight(double acceleration) => Force.Central("weight", V(0, -1e6), acceleration, 0);

    /// <summary>
    /// Rules 1, 5 and 7: a step, and what counts as slow, follow from what pulls the bodies, so a force that presses as gravity does
    /// gives what
    /// gravity gives. Before, such a stack hopped for ever.
    /// </summary>
    [Theory]
    [InlineData(15)]
    [InlineData(50)]
    [InlineData(1000)]
    public void Stack_PressedByAForce_RestsAsUnderGravity(double pull)
    {
        Assert.Equal(StackAfter(pull, byForce: false), StackAfter(pull, byForce: true));
        Assert.Equal("Resting, Resting", StackAfter(pull, byForce: true));
    }

    /// <summary>The control: gravity as large as the force, but pulling aside, is another weight.</summary>
    [Fact]
    public void Stack_PressedAside_DoesNotRest() => Assert.NotEqual("Resting, Resting", StackAfter(15, byForce: false, aside: 5));

    private static string StackAfter(double pull, bool byForce, double aside = 0)
    {
        SceneBuilder builder = new SceneBuilder("stack").WithContactTolerance(1e-3).WithGravity(byForce ? V(0) : V(aside, -pull))
            .AddPlane("floor", V(0, 1), 0, 0.8);
        ForceSet weight = default;
        if (byForce)
        {
            builder.AddForce(Weight(pull), out weight);
        }

        BodySpec ball = new(0.5, 1, 0.8, forces: weight);
        Simulation simulation = Run(builder.AddBody("lower", ball, V(0, 0.5)).AddBody("upper", ball, V(0, 1.5)).Build(), 4);
        return $"{Read(simulation, First, 4).Motion}, {Read(simulation, Second, 4).Motion}";
    }

    /// <summary>A ball slides off a frictionless dome; with the weight as a force it is where gravity has it, and no faster.</summary>
    [Theory]
    [InlineData(9.81)]
    [InlineData(1e3)]
    [InlineData(1e4)]
    public void Dome_UnderAForceAsWeight_IsLeftAsUnderGravity(double pull)
    {
        double seconds = 1.5 / Math.Sqrt(pull);
        BodyState expected = DomeAfter(seconds, pull, byForce: false);
        BodyState actual = DomeAfter(seconds, pull, byForce: true);
        Near(expected.Position, actual.Position, 1e-4);
        Near(expected.Velocity, actual.Velocity, 1e-3 * expected.Velocity.Length);
        Assert.True((expected.Position - DomeAfter(seconds, 1.1 * pull, byForce: true).Position).Length > 1e-2, "the control: a tenth more weight is seen");
    }

    private static BodyState DomeAfter(double seconds, double pull, bool byForce)
    {
        SceneBuilder builder = new SceneBuilder("dome").WithContactTolerance(1e-3).WithGravity(byForce ? V(0) : V(0, -pull))
            .AddStaticSphere("dome", V(0), 1, 0);
        ForceSet weight = default;
        if (byForce)
        {
            builder.AddForce(Weight(pull), out weight);
        }

        double x = 0.3, y = Math.Sqrt((1.5 * 1.5) - (x * x));
        return Read(Run(builder.AddBody("ball", new BodySpec(0.5, 1, 0, forces: weight), V(x, y)).Build(), seconds), First, seconds);
    }

    /// <summary>
    /// Rule 5: what passes a post by more than the tolerance is not touched, however plastic it is. The gap along the line of centres, as
    /// fast
    /// as it closes at the tick, would be used up.
    /// </summary>
    [Theory]
    [InlineData(0.03, 20)]
    [InlineData(0.01, 20)]
    [InlineData(0.002, 5)]
    [InlineData(0.002, 10)]
    public void Pass_BesideAPost_IsNoContact(double miss, double speed)
    {
        BodyState state = Past(miss, speed);
        Assert.Equal(0, state.Velocity.Z);
        Assert.InRange(state.Velocity.X, 0.99 * speed, speed);
    }

    /// <summary>The control: what does not pass is thrown aside.</summary>
    [Fact]
    public void Pass_IntoAPost_IsSeen() => Assert.True(Past(-0.01, 10).Velocity.Z < -0.1);

    private static BodyState Past(double miss, double speed)
    {
        Scene scene = new SceneBuilder("post").WithContactTolerance(1e-3).AddPlane("floor", V(0, 1), 0, 0, 0)
            .AddStaticSphere("post", V(0, 0.1, 0.2 + miss), 0.1)
            .AddForce(Force.QuadraticDrag("air", 1e-4), out ForceSet air)
            .AddBody("ball", new BodySpec(0.1, 1, 0, forces: air), V(-1, 0.1), V(speed)).Build();
        return Read(Run(scene, 2 / speed), First, 2 / speed);
    }

    /// <summary>
    /// Rule 10: a ball that turns in a corner and rubs on floor and wall does not sleep before it has stopped; then it does.
    /// With mu on both, its surface slows by 5/2 mu g (1 + mu) / (1 + mu^2).
    /// </summary>
    [Fact]
    public void Turning_InACorner_GoesOnUntilFrictionHasStoppedIt()
    {
        const double Mu = 0.3, Radius = 0.5, Turns = 50;
        double slowing = 2.5 * Mu * 9.81 * (1 + Mu) / (Radius * (1 + (Mu * Mu)));
        Scene scene = new SceneBuilder("corner").AddPlane("floor", V(0, 1), 0, 0).AddPlane("wall", V(1), 0, 0)
            .AddBody("ball", new BodySpec(Radius, 1, 0, friction: Mu), V(Radius, Radius), spin: V(0, 0, Turns)).Build();
        Simulation simulation = new(scene, KeepAll);
        simulation.AdvanceTo(At(4));
        foreach (double at in new[] { 0.6, 1.5, 2.4 })
        {
            Near(Turns - (slowing * at), Read(simulation, First, at).Spin.Z, 0.2);
        }

        Assert.Equal(MotionLaw.Resting, Read(simulation, First, 4).Motion);
        Near(V(0), Read(simulation, First, 4).Spin, 1e-2);
        Assert.True(Turns / slowing > 2.5, "the control: long after what waits for a sleep would have fallen asleep");
    }

    /// <summary>
    /// What is put into another is pushed out of it: in the air as on a floor, side by side, one above the other or both in one place.
    /// </summary>
    [Theory]
    [InlineData(0, 0, true)]
    [InlineData(0.05, 0, true)]
    [InlineData(0.15, 0, true)]
    [InlineData(0, 0.1, true)]
    [InlineData(0, 0, false)]
    [InlineData(0.15, 0, false)]
    public void Body_PutIntoAnother_IsPushedOut(double x, double y, bool falls)
    {
        Assert.InRange(OverlapAfterPuttingInto(x, y, falls, ignoresIslands: false), double.NegativeInfinity, 1e-3);
        Assert.True(OverlapAfterPuttingInto(x, 0, falls, ignoresIslands: true) > 0.04, "the control: without islands it stays inside");
    }

    private static double OverlapAfterPuttingInto(double x, double y, bool falls, bool ignoresIslands)
    {
        SceneBuilder builder = new SceneBuilder("inside").WithContactTolerance(1e-3).WithGravity(falls ? V(0, -9.81) : V(0));
        builder = falls ? builder.AddPlane("floor", V(0, 1), 0) : builder;
        BodySpec ball = new(0.1, 1, 0.3, friction: 0.5);
        Scene scene = builder.AddBody("ball", ball, V(0, 0.1)).AddBody("other", ball, V(3, 0.1)).Build();
        Simulation simulation = new(scene, KeepAll.WithParts(new FaultyEngineParts { IgnoresIslands = ignoresIslands }));
        simulation.AdvanceTo(At(0.5));
        simulation.Submit(PlayerAction.Teleport(Second, V(x, 0.1 + y)).Stamp(At(0.6), 1, 1)); // to come, so that bodies in flight are predicted as flights are
        double end = falls ? 12 : 40; // without gravity it is pushed out a tenth as fast
        simulation.AdvanceTo(At(end));
        return 0.2 - (Read(simulation, First, end).Position - Read(simulation, Second, end).Position).Length;
    }

    /// <summary>
    /// Rule 14: elastic balls that fall into a pit get no deeper into each other than the tolerance, though contacts that hold may close
    /// for a
    /// while before they are struck again. The control: with a tolerance fifty times as large they do. Where each impact allowed the whole room
    /// again, they were 15 mm deep.
    /// </summary>
    [Theory]
    [InlineData(1e-3, true)]
    [InlineData(0.05, false)]
    public void Heap_OfElasticBalls_IsNotDeeperThanTheTolerance(double tolerance, bool isSo)
    {
        SceneBuilder builder = new SceneBuilder("pit").WithContactTolerance(tolerance).AddPlane("floor", V(0, 1), 0)
            .AddPlane("left", V(1), -0.25).AddPlane("right", V(-1), -0.25).AddPlane("front", V(0, 0, 1), -0.25).AddPlane("back", V(0, 0, -1), -0.25);
        Random random = new(4);
        for (int n = 0; n < 16; n++)
        {
            double x = (n % 2 == 0 ? -0.11 : 0.11) + (0.005 * random.NextDouble()), z = (n / 2 % 2 == 0 ? -0.11 : 0.11) + (0.005 * random.NextDouble());
            builder.AddBody($"b{n}", new BodySpec(0.1, 1, 1, friction: 0.3), V(x, 0.3 * (1 + (n / 4)), z));
        }

        Simulation simulation = new(builder.Build(), new SimulationOptions(default, SimDuration.FromSeconds(1)));
        double deepest = 0;
        for (int n = 1; n <= 300; n++)
        {
            simulation.AdvanceTo(At(n * 0.02));
            deepest = Math.Max(deepest, -MinGap(simulation, At(n * 0.02)));
        }

        Assert.True(isSo == deepest <= 1e-3, $"{deepest}");
    }
}
