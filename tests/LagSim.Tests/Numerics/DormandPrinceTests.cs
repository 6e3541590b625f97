using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Numerics;

/// <summary>Error control: what a tolerance promises, what stiffness and singularities do.</summary>
public sealed class DormandPrinceTests
{
    /// <summary>A ball that falls against the square of its speed: v = vt tanh(g t / vt), y = vt²/g ln cosh(g t / vt).</summary>
    [Theory]
    [InlineData(1e-3)]
    [InlineData(1e-6)]
    [InlineData(1e-9)]
    [InlineData(1e-12)]
    public void QuadraticDrag_Falling_IsWithinTheTolerancesOfItsSteps(double tolerance)
    {
        Simulation world = Fall(tolerance, out int steps);
        double t = At(6).SecondsSince(default), terminal = Math.Sqrt(9.81 / 0.05);
        double fallen = terminal * terminal / 9.81 * Math.Log(Math.Cosh(9.81 * t / terminal));
        BodyState state = Read(world, First, 6);

        // Falling against drag forgets errors of the velocity, so what is left of the position's is the sum of the steps', and what a velocity's moves it until forgotten, vt / 2g.
        double allowed = tolerance * steps * (1 + (terminal / 19.62));
        Near(-fallen, state.Position.Y, allowed + 1e-13);
        Near(-terminal * Math.Tanh(9.81 * t / terminal), state.Velocity.Y, allowed + 1e-13);
    }

    /// <summary>The fifth order: a tolerance 1e5 times as small costs some ten times the steps, and not 1e5.</summary>
    [Fact]
    public void Steps_OfATolerance1e5TimesAsSmall_AreTenTimesAsMany()
    {
        Fall(1e-6, out int few);
        Fall(1e-11, out int many);
        Assert.InRange((double)many / few, 5, 15);
    }

    /// <summary>Thick drag far above what a fixed step could follow: sub-stepped, and the body does not move on.</summary>
    [Theory]
    [InlineData(MotionLaw.DormandPrince54)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void StiffDrag_IsSubStepped(MotionLaw law)
    {
        Simulation world = new(
            new SceneBuilder("tar").WithGravity(default).AddForce(Force.QuadraticDrag("tar", 100), out ForceSet tar)
                .AddBody("ball", new BodySpec(0.1, 1, 1, law, SimDuration.FromSeconds(0.1), tar, 1e-6), V(0), V(100)).Build(),
            KeepAll);
        world.AdvanceTo(At(1));
        double t = At(1).SecondsSince(default);
        Near(Math.Log(1 + (100 * 100 * t)) / 100, Read(world, First, 1).Position.X, law == MotionLaw.RungeKutta4 ? 1e-2 : 1e-5); // stable is not exact
        Near(100 / (1 + (100 * 100 * t)), Read(world, First, 1).Velocity.X, law == MotionLaw.RungeKutta4 ? 1e-3 : 1e-5);
        Assert.True(world.Timeline(First).Count > 12, "The step of 0.1 s was to be divided.");
    }

    /// <summary>Fixed steps too: forces of the library's own, whose rate is known, and a program's, whose rate is estimated.</summary>
    [Fact]
    public void FixedSteps_UnderStiffForces_AreSubStepped()
    {
        foreach (Force force in new[] { Force.LinearDrag("glue", 5000), Force.Supplied(new FunctionForce((_, _, v) => v * -5000)) })
        {
            Scene scene = new SceneBuilder("glue").WithGravity(default).AddForce(force, out ForceSet glue)
                .AddBody("ball", new BodySpec(0.1, 1, 1, MotionLaw.DormandPrince54, SimDuration.FromSeconds(0.01), glue, 0), V(0), V(5)).Build();
            BodyState end = Read(Run(scene, 0.2), First, 0.2);
            Near(5.0 / 5000, end.Position.X, 1e-5);
            Near(V(0), end.Velocity, 1e-9);
        }
    }

    /// <summary>
    /// A step that leads to where a force is far stiffer than at its start: a body shot out of a well, which has it back after 76 m, does not blow up. The
    /// control: one step of 1 s without regard to its
    /// end puts it 20,000 km out.
    /// </summary>
    [Theory]
    [InlineData(MotionLaw.RungeKutta4)]
    [InlineData(MotionLaw.DormandPrince54)]
    public void FixedSteps_ThatLeadToStiffForces_AreSubSteppedToo(MotionLaw law)
    {
        const double s = 1e-3, v = 1000; // v² / 2 = s r^5 / 5 at 75.8 m
        Scene scene = new SceneBuilder("well").WithGravity(default).AddForce(Force.Central("well", V(0), s, 4), out ForceSet well)
            .AddBody("ball", new BodySpec(0.1, 1, 1, law, SimDuration.FromSeconds(1), well, 0), V(0), V(v)).Build();
        Simulation world = Run(scene, 5);
        for (int n = 1; n <= 50; n++)
        {
            Assert.InRange(Read(world, First, n * 0.1).Position.Length, 0, 760);
        }

        double middle = -s * Math.Pow(v / 2, 4); // the second stage and the third are of the same place
        Assert.True(Math.Abs((v + (2 * v) + (2 * (v + (middle / 2))) + (v + middle)) / 6) > 1e7);
    }

    /// <summary>The control: at the same step a Runge-Kutta method without sub-steps leaves the world at once.</summary>
    [Fact]
    public void StiffDrag_OfAnUndividedStep_BlowsUp()
    {
        double x = 0, v = 100;
        for (int i = 0; i < 10; i++)
        {
            const double h = 0.1;
            double a1 = -100 * v * Math.Abs(v), v2 = v + (a1 * h / 2), a2 = -100 * v2 * Math.Abs(v2), v3 = v + (a2 * h / 2);
            double a3 = -100 * v3 * Math.Abs(v3), v4 = v + (a3 * h), a4 = -100 * v4 * Math.Abs(v4);
            x += (v + (2 * v2) + (2 * v3) + v4) * h / 6;
            v += (a1 + (2 * a2) + (2 * a3) + a4) * h / 6;
        }

        Assert.False(Math.Abs(x) < 1e6);
    }

    /// <summary>A program's own stiff force, of which nothing is known but what its stages show.</summary>
    [Theory]
    [InlineData(2_000)]
    [InlineData(100_000)]
    public void SuppliedStiffForce_OnRungeKutta4_IsSubSteppedToo(double rate)
    {
        Simulation world = new(
            new SceneBuilder("glue").WithGravity(default).AddForce(Force.Supplied(new FunctionForce((_, _, v) => (v - V(1)) * -rate)), out ForceSet glue)
                .AddBody("ball", new BodySpec(0.1, 1, 1, MotionLaw.RungeKutta4, SimDuration.FromSeconds(0.01), glue), V(0), V(5)).Build(),
            new SimulationOptions(default, SimDuration.FromSeconds(0.01)));
        world.AdvanceTo(At(0.2));
        Near(0.2 + (4 / rate), Read(world, First, 0.2).Position.X, 4 / rate);
        Near(V(1), Read(world, First, 0.2).Velocity, 1e-6);
    }

    [Fact]
    public void SuppliedForceTooStiffForAnyStep_EndsTheWorldWithItsName()
    {
        Scene scene = new SceneBuilder("steel").WithGravity(default).AddForce(Force.Supplied(new FunctionForce((_, _, v) => v * -1e8)), out ForceSet steel)
            .AddBody("ball", new BodySpec(0.1, 1, 1, MotionLaw.RungeKutta4, default, steel), V(0), V(5)).Build();
        SimulationException refused = Assert.Throws<SimulationException>(() => new Simulation(scene).AdvanceTo(At(1)));
        Assert.Contains("the forces 'test force' on body 'ball' (0.0.0) change faster than the shortest step follows", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Singularity_TakesTheBodyOutOfTheWorld()
    {
        Scene scene = new SceneBuilder("hole").WithGravity(default).AddForce(Force.Central("hole", V(0), 1, -3), out ForceSet hole)
            .AddBody("ball", new BodySpec(0.1, 1, 1, forces: hole), V(1)).Build();
        Simulation world = new(scene);
        world.AdvanceTo(At(5));
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal((First, LossReason.TooStiff), (lost.Body, lost.Reason));
        Assert.InRange(lost.Position.Length, 0, 1e-3);
    }

    /// <summary>Cutting the flight anywhere and going on from there changes the steps, and the path only within the tolerance; without a cut it is the same to the bit.</summary>
    [Fact]
    public void Advance_InPieces_IsTheSameToTheBit()
    {
        Simulation once = Fall(1e-9, out _), often = new(once.Scene, KeepAll);
        for (int i = 1; i <= 60; i++)
        {
            often.AdvanceTo(At(0.1 * i));
        }

        Assert.Equal(once.StateHash(At(6)), often.StateHash(At(6)));
        Assert.Equal(once.EventHash(At(6)), often.EventHash(At(6)));
    }

    [Theory]
    [InlineData(1e-30, 5)]
    [InlineData(32, 5)]
    [InlineData(0.7, 6)]
    [InlineData(1e30, 7)]
    public void Root_IsGoodToAHundredThousandth(double number, int degree) =>
        Near(Math.Pow(number, 1.0 / degree), StepSize.Root(number, degree), 2e-5 * Math.Pow(number, 1.0 / degree));

    private static Simulation Fall(double tolerance, out int steps)
    {
        Scene scene = new SceneBuilder("fall").AddForce(Force.QuadraticDrag("air", 0.1), out ForceSet air)
            .AddBody("ball", new BodySpec(0.1, 2, 1, forces: air, tolerance: tolerance), V(0)).Build();
        Simulation world = new(scene, KeepAll);
        world.AdvanceTo(At(6));
        steps = world.Timeline(First).Count;
        return world;
    }
}
