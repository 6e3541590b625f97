using System;
using System.Linq;
using LagSim.Scenes;
using MathNet.Numerics;
using Xunit;

namespace LagSim.Tests.Numerics;

/// <summary>The measured order of the integrator: the slope of error against step, both logarithmic.</summary>
public sealed class ConvergenceTests
{
    private const double End = 2;
    private const double Finest = 1.0 / 2048;

    private static readonly double[] Steps = [1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128];

    private delegate Vector3D Solution(double step);

    [Fact]
    public void RungeKutta4_ForceOfVelocityPlaceAndTime_HasOrderFour()
    {
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -100).Position);
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -100).Velocity);
    }

    [Fact]
    public void RungeKutta4_BetweenSteps_HasOrderFour()
    {
        // 1.987 s lies on no grid: this is the dense output.
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -100, at: 1.987).Position);
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -100, at: 1.987).Velocity);
    }

    [Fact]
    public void RungeKutta4_ThroughContacts_KeepsOrderFour()
    {
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -0.3).Position);
        AssertOrderFour(step => Engine(Driven, step, e: 0.9, floor: -0.3).Velocity);
        Simulation bouncing = Simulate(Driven, 1.0 / 64, e: 0.9, floor: -0.3);
        Assert.True(TestWorlds.Impacts(bouncing, TestWorlds.First).Count >= 1);
    }

    [Fact]
    public void DormandPrince54_FixedSteps_HasOrderFive()
    {
        AssertOrderFive(step => Engine(Driven, step, e: 0.9, floor: -100, law: MotionLaw.DormandPrince54).Position);
        AssertOrderFive(step => Engine(Driven, step, e: 0.9, floor: -100, at: 1.987, law: MotionLaw.DormandPrince54).Position);
        AssertOrderFive(step => Engine(Driven, step, e: 0.9, floor: -100, law: MotionLaw.DormandPrince54).Velocity);
    }

    [Fact]
    public void DormandPrince54_FixedStepsThroughContacts_KeepsOrderFive()
    {
        AssertOrderFive(step => Engine(Driven, step, e: 0.9, floor: -0.3, law: MotionLaw.DormandPrince54).Position);
        AssertOrderFive(step => Engine(Driven, step, e: 0.9, floor: -0.3, at: 1.987, law: MotionLaw.DormandPrince54).Position);
        Simulation bouncing = Simulate(Driven, 1.0 / 64, e: 0.9, floor: -0.3, law: MotionLaw.DormandPrince54);
        Assert.True(TestWorlds.Impacts(bouncing, TestWorlds.First).Count >= 1);
    }

    [Fact]
    public void Order_OfRungeKutta4_FailsTheCheckForFive() =>
        Assert.False(IsFive(Order(step => Engine(Driven, step, e: 0.9, floor: -0.3).Position, Engine(Driven, Finest, e: 0.9, floor: -0.3).Position)));

    [Fact]
    public void RungeKutta4_HarmonicOscillator_LosesTheAmplitudeThatTheoryGives()
    {
        const double Omega = 8, Step = 1.0 / 32;
        const double Z = Omega * Step;
        Simulation simulation = Simulate((_, x, _) => x * (-Omega * Omega), Step, e: 1, floor: -100, start: TestWorlds.V(1), velocity: Vector3D.Zero);
        BodyState end = TestWorlds.Read(simulation, TestWorlds.First, End);
        double amplitude = Math.Sqrt(end.Position.LengthSquared + (end.Velocity.LengthSquared / (Omega * Omega)));
        double factor = Math.Sqrt(1 - (Math.Pow(Z, 6) / 72) + (Math.Pow(Z, 8) / 576));
        TestWorlds.Near(Math.Pow(factor, End / Step), amplitude, 1e-13);
    }

    [Fact]
    public void Order_OfTheThesisUpdate_IsOneAndFailsTheCheck()
    {
        double order = Order(step => Thesis(Driven, step), Engine(Driven, Finest, e: 0.9, floor: -100).Position);
        TestWorlds.Near(1, order, 0.1);
        Assert.False(IsFour(order));
    }

    [Fact]
    public void Order_OfContactsMovedToTheNearestStep_FailsTheCheck()
    {
        Vector3D reference = Engine(Driven, Finest, e: 0.9, floor: -0.3).Position;
        Assert.False(IsFour(Order(step => Snapped(Driven, step, floor: -0.3), reference)));
    }

    private static Vector3D Driven(double t, Vector3D x, Vector3D v) =>
        (x * -4) - (v * (0.4 * v.Length)) + new Vector3D(-v.Z + t, v.Z * 0.5, v.X - (t * t));

    private static void AssertOrderFour(Solution solve)
    {
        double order = Order(solve, solve(Finest));
        Assert.True(IsFour(order), $"The measured order is {order:F3}.");
    }

    private static void AssertOrderFive(Solution solve)
    {
        double order = Order(solve, solve(1.0 / 1024));
        Assert.True(IsFive(order), $"The measured order is {order:F3}.");
    }

    private static bool IsFive(double order) => Math.Abs(order - 5) <= 0.3;

    private static bool IsFour(double order) => Math.Abs(order - 4) <= 0.1;

    private static double Order(Solution solve, Vector3D reference)
    {
        double[] errors = Steps.Select(step => Math.Log((solve(step) - reference).Length)).ToArray();
        return Fit.Line(Steps.Select(step => Math.Log(step)).ToArray(), errors).B;
    }

    private static BodyState Engine(
        Func<double, Vector3D, Vector3D, Vector3D> force, double step, double e, double floor, double at = End, MotionLaw law = MotionLaw.RungeKutta4) =>
        TestWorlds.Read(Simulate(force, step, e, floor, law: law), TestWorlds.First, at);

    private static Simulation Simulate(
        Func<double, Vector3D, Vector3D, Vector3D> force, double step, double e, double floor, Vector3D? start = null, Vector3D? velocity = null,
        MotionLaw law = MotionLaw.RungeKutta4)
    {
        Scene scene = new SceneBuilder("driven").WithGravity(default).AddPlane("floor", Vector3D.Up, TestWorlds.V(0, floor - 0.1))
            .AddForce(Force.Supplied(new FunctionForce(force)), out ForceSet driving)
            .AddBody("ball", new BodySpec(0.1, 1, e, law, LagSim.Time.SimDuration.FromSeconds(step), driving, tolerance: 0), start ?? Start, velocity ?? Velocity).Build();
        return TestWorlds.Run(scene, End);
    }

    private static Vector3D Start => new(1, 0.5, -0.2);

    private static Vector3D Velocity => new(0, 1, 0.7);

    /// <summary>As the thesis's code has it: fourth order for the velocity, and the position moved with the velocity at the end.</summary>
    private static Vector3D Thesis(Func<double, Vector3D, Vector3D, Vector3D> force, double h)
    {
        Vector3D x = Start, v = Velocity;
        for (int i = 0; i < End / h; i++)
        {
            (_, v) = Classical(force, i * h, x, v, h);
            x += v * h;
        }

        return x;
    }

    /// <summary>Fourth order between contacts, which act at the end of the step that crosses them.</summary>
    private static Vector3D Snapped(Func<double, Vector3D, Vector3D, Vector3D> force, double h, double floor)
    {
        Vector3D x = Start, v = Velocity;
        for (int i = 0; i < End / h; i++)
        {
            (x, v) = Classical(force, i * h, x, v, h);
            v = x.Y < floor && v.Y < 0 ? new Vector3D(v.X, -0.9 * v.Y, v.Z) : v;
        }

        return x;
    }

    private static (Vector3D X, Vector3D V) Classical(Func<double, Vector3D, Vector3D, Vector3D> f, double t, Vector3D x, Vector3D v, double h)
    {
        Vector3D k1 = f(t, x, v);
        Vector3D k2 = f(t + (h / 2), x + (v * (h / 2)), v + (k1 * (h / 2)));
        Vector3D k3 = f(t + (h / 2), x + ((v + (k1 * (h / 2))) * (h / 2)), v + (k2 * (h / 2)));
        Vector3D k4 = f(t + h, x + ((v + (k2 * (h / 2))) * h), v + (k3 * h));
        return (x + ((v + ((k1 + k2 + k3) * (h / 6))) * h), v + ((k1 + (k2 * 2) + (k3 * 2) + k4) * (h / 6)));
    }
}
