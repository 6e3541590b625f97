using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Invalid numbers wherever a number enters a scene: zero, negative, subnormal, huge, and NaN. The result must be an immediate error that
/// names the value and what is allowed, or a right answer.
/// </summary>
internal sealed class BadInputCase : IHardCase
{
    private const double Apart = 10; // metres that the ball falls, at least
    private const double Swing = 100; // rad/s of a spring, so stiff that steps differ visibly

    private static readonly double[] Values =
    [
        0, -0.0, 1, -1, double.Epsilon, -double.Epsilon, 1e-310, 2.2250738585072014e-308, 1e-300, 1e-155, 1e-31, 1e-30, 1e-12, 1e-9, 1e-6, 1e-3, 0.5, 2, 1e3,
        1e9, 1.1e9, 1e12, 1e30, 1.1e30, 1e155, 1e300,
        double.MaxValue, -double.MaxValue, double.PositiveInfinity, double.NegativeInfinity, double.NaN,
    ];

    /// <summary>
    /// An input: a scene with it, and the textbook position of a ball released at rest, a second later; null where it only has to be finite
    /// or end with an error.
    /// </summary>
    private static readonly (string What, Func<double, SceneBuilder> Scene, Func<double, double?> Place)[] Inputs =
    [
        ("radius", r => Ball(new BodySpec(r, 1, 0.5), floor: -1e10), _ => -Gravity / 2),
        ("mass", m => Ball(new BodySpec(0.5, m, 0.5)), _ => -Gravity / 2),
        ("restitution", e => Ball(new BodySpec(0.5, 1, e)), _ => -Gravity / 2),
        ("speed", v => Ball(new BodySpec(0.5, 1, 0.5), v), _ => -Gravity / 2),
        ("spin", w => Ball(new BodySpec(0.5, 1, 0.5, friction: 0.5), spin: w), _ => -Gravity / 2),
        ("friction", f => Ball(new BodySpec(0.5, 1, 0.5, friction: f)), _ => -Gravity / 2),
        ("rolling resistance", f => Ball(new BodySpec(0.5, 1, 0.5, friction: 0.5, rollingResistance: f)), _ => -Gravity / 2),
        ("tolerance of Dormand-Prince", t => Pulled(MotionLaw.DormandPrince54, t, Force.QuadraticDrag("air", 0)), _ => -Gravity / 2),
        ("tolerance of the closed form", t => Pulled(MotionLaw.ClosedForm, t, Force.LinearDrag("oil", 0)), _ => -Gravity / 2),
        ("tolerance at rest", t => Pulled(MotionLaw.DormandPrince54, t, Force.Supplied(new SuppliedForce(Force.Spring("spring", default, 1)))).WithGravity(default), _ => 0),
        ("step under a spring", h => Stepped(SimDuration.FromSeconds(h)), StepsOf),
        ("gravity", g => Ball(new BodySpec(0.5, 1, 0.5), floor: -1e7).WithGravity(V(0, g)), g => g / 2),
        ("restitution threshold", r => Ball(new BodySpec(0.5, 1, 0.5)).WithRestitutionThreshold(r), _ => -Gravity / 2),
        ("contact tolerance", d => Ball(new BodySpec(0.5, 1, 0.5)).WithContactTolerance(d), _ => -Gravity / 2),
        ("smallest radius", r => Ball(new BodySpec(0.5, 1, 0.5)).WithSmallestRadius(r), _ => -Gravity / 2),
        ("offset of a plane", d => new SceneBuilder("bad").AddPlane("floor", Vector3D.Up, d - Apart - 0.5).AddBody("ball", new BodySpec(0.5, 1, 0), V(0, d)),
            d => d - (Gravity / 2)),
        ("radius of a static sphere", r => Ball(new BodySpec(0.5, 1, 0.5)).AddStaticSphere("stone", V(0, 3e9), r), _ => -Gravity / 2),
        ("coefficient of linear drag", c => Pulled(MotionLaw.Automatic, 1e-9, Force.LinearDrag("oil", c)), Dragged),
        ("coefficient of quadratic drag", k => Pulled(MotionLaw.Automatic, 1e-9, Force.QuadraticDrag("air", k)), _ => null),
        ("stiffness", k => Pulled(MotionLaw.Automatic, 1e-9, Force.Spring("spring", default, k)), Sprung),
        ("damping", c => Pulled(MotionLaw.Automatic, 1e-9, Force.Spring("spring", default, 0, c)), Dragged),
        ("charge", q => Pulled(MotionLaw.Automatic, 1e-9, Force.Magnetic("coil", Vector3D.Up, q)), _ => -Gravity / 2),
        ("strength of a pull", s => Pulled(MotionLaw.Automatic, 1e-9, Force.Central("sun", V(0, -1000), s)), _ => null),
    ];

    public string Name => "bad-input";

    public string Title => "zero, negative, subnormal, huge and no numbers wherever one enters a scene: a clear sentence at once, or a right answer";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((string what, Func<double, SceneBuilder> scene, Func<double, double?> place) in Inputs)
        {
            yield return Row(context, what, scene, place);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return Row(context, "mass", m => Ball(new BodySpec(0.5, Math.Clamp(m, 1e-30, 1e30), 0.5)).WithGravity(V(0, -Gravity * (1 + 1e-6))),
            _ => -Gravity / 2) with
        {
            Note = "masses clamped in silence, and gravity off by a millionth",
        };
        yield return Row(context, "step under a spring", h => Stepped(SimDuration.FromSeconds(Math.Abs(h) < 1e-12 ? 0.005 : h)), StepsOf) with
        {
            Note = "steps below a tick taken for the default in silence",
        };
        yield return Row(context, "mass", _ => throw new SceneException("This cannot be."), _ => -Gravity / 2) with { Note = "a refusal that says nothing" };
    }

    private static SceneBuilder Ball(BodySpec ball, double speed = 0, double spin = 0, double floor = -Apart - 0.5) =>
        new SceneBuilder("bad").AddPlane("floor", Vector3D.Up, V(0, floor)).AddBody("ball", ball, default, V(speed), spin: V(0, spin));

    private static SceneBuilder Pulled(MotionLaw law, double tolerance, Force force) =>
        new SceneBuilder("bad").AddForce(force).AddBody("ball", new BodySpec(0.5, 1, 0.5, law, default, ForceSet.Of(0), tolerance), default);

    private static SceneBuilder Stepped(SimDuration step) => new SceneBuilder("bad").AddForce(Force.Spring("spring", default, Swing * Swing))
        .AddBody("ball", new BodySpec(0.5, 1, 0.5, MotionLaw.RungeKutta4, step, ForceSet.Of(0)), default);

    /// <summary>
    /// Returns the position by the classical Runge-Kutta method with steps h of a body that starts at rest at the anchor of a spring of w²
    /// N/m: (Re R(i w h)^(1/h) - 1) g / w², with R(z) = 1 + z + z²/2 + z³/6 + z⁴/24. Null where w h is so large that the method is
    /// unstable, or h too short to be a step.
    /// </summary>
    private static double? StepsOf(double h)
    {
        double z = Swing * h, re = 1 - (z * z / 2) + (z * z * z * z / 24), im = z - (z * z * z / 6);
        double length = Math.Pow((re * re) + (im * im), 0.5 / h), angle = Math.Atan2(im, re) / h;
        return h is >= 1e-6 and <= 5e-3 ? ((length * Math.Cos(angle)) - 1) * Gravity / (Swing * Swing)
            : h > 5e-3 ? null : (Math.Cos(Swing) - 1) * Gravity / (Swing * Swing);
    }

    /// <summary>
    /// Returns the distance fallen from rest after a second, against linear drag c on 1 kg: g (1 + (exp(-c) - 1) / c) / c.
    /// </summary>
    private static double? Dragged(double c) =>
        -Gravity * (c > 1e-3 ? (1 + ((Math.Exp(-c) - 1) / c)) / c : 0.5 - (c / 6) + (c * c / 24) - (c * c * c / 120));

    /// <summary>
    /// Returns the position after a second of a body that starts at rest at the anchor of a spring: -g (1 - cos w) / w^2.
    /// </summary>
    private static double? Sprung(double k)
    {
        double half = Math.Sqrt(k) / 2, sinc = half > 1e-9 ? Math.Sin(half) / half : 1;
        return -Gravity / 2 * sinc * sinc;
    }

    private HardRow Row(HardContext context, string what, Func<double, SceneBuilder> scene, Func<double, double?> place)
    {
        int wrong = 0, refused = 0;
        string first = "";
        foreach (double value in Values)
        {
            string? fault = Fault(context, value, scene, place, ref refused);
            wrong += fault is null ? 0 : 1;
            first = first.Length > 0 || fault is null ? first : string.Create(CultureInfo.InvariantCulture, $"{value:R}: {fault}");
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{what}, {Values.Length} values"), wrong, "count", 0,
            "a sentence has the value in it, or it has not; a place is within 1e-8 of the textbook's, with tolerances of 1e-9, and a part of its size",
            "the value in the sentence; the place a second later")
        {
            Note = FormattableString.Invariant($"{refused} refused{(first.Length > 0 ? "; " : "")}{first}"),
        };
    }

    /// <summary>Returns what is wrong with the result for a value; null if nothing is.</summary>
    private static string? Fault(HardContext context, double value, Func<double, SceneBuilder> scene, Func<double, double?> place, ref int refused)
    {
        Scene built;
        try
        {
            built = scene(value).Build();
        }
        catch (Exception refusal) when (refusal is SceneException or ArgumentOutOfRangeException)
        {
            refused++;
            bool namesValue = refusal.Message.Contains(value.ToString("R", CultureInfo.InvariantCulture), StringComparison.Ordinal)
                || (refusal is ArgumentOutOfRangeException { ActualValue: double actual } && actual.Equals(value))
                || (Math.Abs(value) < 1e6 && refusal.Message.Contains(SimDuration.FromSeconds(value).ToShortString(), StringComparison.Ordinal)); // a step is rounded to ticks first
            bool saysWhatIsAllowed = refusal.Message.Contains("must", StringComparison.Ordinal) || refusal.Message.Contains("allowed", StringComparison.Ordinal)
                || refusal.Message.Contains("at most", StringComparison.Ordinal);
            return namesValue && saysWhatIsAllowed ? null : "an unclear refusal: " + refusal.Message;
        }

        try
        {
            Simulation simulation = context.Simulate(built, SimDuration.FromSeconds(1e-3));
            simulation.AdvanceTo(SimTime.FromSeconds(1));
            BodyState state = Read(simulation, 0, 1);
            double? expected = place(value);
            double off = expected is double y ? Math.Abs(state.Position.Y - y) : 0, size = Math.Max(1, Math.Abs(expected ?? 0));
            return !state.Position.IsFinite || !state.Velocity.IsFinite || !(off <= 1e-8 * size)
                ? FormattableString.Invariant($"at {state.Position} and not {expected}") : null;
        }
        catch (SimulationException end)
        {
            // Without a textbook answer it may end in a singularity, with an error.
            return place(value) is null ? null : "ended later: " + end.Message;
        }
    }
}
