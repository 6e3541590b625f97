using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using MathNet.Numerics;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The measured order of the integrator, with drag, in between steps, and through contacts.</summary>
internal sealed class OrderCase : IHardCase
{
    private const double End = 2;
    private const double Finest = 1.0 / 2048;
    private const double E = 0.9;
    private const double NoFloor = -100;
    private const double Floor = -0.3;

    private static readonly double[] Steps = [1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128];
    private static readonly Vector3D Start = new(1, 0.5, -0.2);
    private static readonly Vector3D StartVelocity = new(0, 1, 0.7);

    public string Name => "order";

    public string Title => "the measured orders of Runge-Kutta and Dormand-Prince steps of fixed length under a driven spring with quadratic drag and a"
        + " magnetic part, through contacts";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((string what, double floor, double at) in new[] { ("smooth", NoFloor, End), ("between steps", NoFloor, 1.987),
            ("through contacts", Floor, End) })
        {
            yield return Row(what + ", position", step => Engine(context, step, floor, at).Position, Engine(context, Finest, floor, at).Position);
            yield return Row(what + ", velocity", step => Engine(context, step, floor, at).Velocity, Engine(context, Finest, floor, at).Velocity);
            yield return Fifth(context, what + ", position, Dormand-Prince", floor, at, MotionLaw.DormandPrince54);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Vector3D smooth = Engine(context, Finest, NoFloor, End).Position, bounced = Engine(context, Finest, Floor, End).Position;
        yield return Row("smooth, position", step => Textbook(ClassicalRungeKutta.ThesisStep, step),
            smooth) with
        { Note = "the thesis's update of the position" };
        yield return Fifth(context, "through contacts, position, Dormand-Prince", Floor, End, MotionLaw.RungeKutta4) with
        {
            Note = "the classical method in place of Dormand and Prince's",
        };
        yield return Row("through contacts, position", step => Textbook(ClassicalRungeKutta.Snapped(Floor, E), step),
            bounced) with
        { Note = "contacts moved to the end of their step" };
    }

    private static Vector3D Textbook(ClassicalRungeKutta.Method method, double step) =>
        ClassicalRungeKutta.Run(method, ClassicalRungeKutta.Of(new Driven()), Start, StartVelocity, step, (long)Math.Round(End / step)).X;

    private static BodyState Engine(HardContext context, double step, double floor, double at, MotionLaw law = MotionLaw.RungeKutta4)
    {
        Scene scene = Floating("driven").AddPlane("floor", Vector3D.Up, V(0, floor - 0.1)).AddForce(Force.Supplied(new Driven()))
            .AddBody("ball", new BodySpec(0.1, 1, E, law, SimDuration.FromSeconds(step), ForceSet.Of(0), 0), Start, StartVelocity).Build();
        return Read(context.Run(scene, End), 0, at);
    }

    private HardRow Fifth(HardContext context, string what, double floor, double at, MotionLaw law)
    {
        Vector3D reference = Engine(context, 1.0 / 1024, floor, at, MotionLaw.DormandPrince54).Position;
        double order = Order(step => Engine(context, step, floor, at, law).Position, reference);
        return new HardRow(
            Name, FormattableString.Invariant($"{what}, steps 1/16 to 1/128 s"), Math.Abs(order - 5), "order_off_5", 0.3,
            "the method has order 5 and is carried on with it; what the next order adds over these steps changes the slope by less than 0.3",
            "the engine at a step of 1/1024 s, 32,768 times as exact as at 1/128")
        {
            Note = FormattableString.Invariant($"measured order {order:0.000}"),
        };
    }

    private static double Order(Func<double, Vector3D> solve, Vector3D reference)
    {
        double[] errors = Steps.Select(step => Math.Log((solve(step) - reference).Length)).ToArray();
        return Fit.Line(Steps.Select(step => Math.Log(step)).ToArray(), errors).B;
    }

    private HardRow Row(string what, Func<double, Vector3D> solve, Vector3D reference)
    {
        double order = Order(solve, reference);
        return new HardRow(
            Name, FormattableString.Invariant($"{what}, steps 1/16 to 1/128 s"), Math.Abs(order - 4), "order_off_4", 0.1,
            "the classical method has order 4; what the next order adds over these steps changes the slope by less than 0.1",
            FormattableString.Invariant($"the engine at a step of 1/{1 / Finest:0} s, 65,536 times as exact as at 1/128"))
        {
            Note = FormattableString.Invariant($"measured order {order:0.000}"),
        };
    }

    /// <summary>A spring with quadratic drag, a part across the velocity and a push that changes with time.</summary>
    private sealed class Driven : IAcceleration
    {
        public string Name => "driven spring with drag";

        public int Version => 1;

        public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) =>
            (position * -4) - (velocity * (0.4 * velocity.Length)) + new Vector3D(-velocity.Z + seconds, velocity.Z * 0.5, velocity.X - (seconds * seconds));
    }
}
