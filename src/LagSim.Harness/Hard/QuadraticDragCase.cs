using System;
using System.Collections.Generic;
using LagSim.Harness.Forces;
using LagSim.Scenes;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>Drag in proportion to the square of the speed, falling and bouncing, against tanh and ln cosh, hop by hop.</summary>
/// <remarks>
/// On v' = f(v) the classical method's local error is at most 73/720 M L^4 h^5 (Lotkin 1951, also Ralston 1962), where |f| is at most M, |f'| at most L and
/// |f''| at most L^2/M; one L less for the place, the integral. Where the speed changes sign f'' jumps: that step is off by at most k (gh)^2 h. Drag only ever
/// damps an error of the speed.
/// </remarks>
internal sealed class QuadraticDragCase : IHardCase
{
    private const double K = 0.02; // per metre
    private const double E = 0.9;
    private const double Height = 5;
    private const double Seconds = 8; // of bouncing

    private static readonly double Terminal = Math.Sqrt(Gravity / K);

    public string Name => "drag-quadratic";

    public string Title => "quadratic drag, falling and bouncing, on Runge-Kutta steps";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double step in context.Sizes([1.0 / 32], [1.0 / 16, 1.0 / 64, 1.0 / 256]))
        {
            yield return FallRow(context, new QuadraticDrag(K), step);
            yield return BounceRow(step, Bounces(context, new QuadraticDrag(K), step));
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const double step = 1.0 / 32;
        yield return FallRow(context, new QuadraticDrag(K * (1 + 1e-4)), step) with { Note = "k off by 1e-4" };
        yield return BounceRow(step, Bounces(context, new QuadraticDrag(K * (1 + 1e-3)), step)) with { Note = "k off by 1e-3" };
        double[] snapped = ClassicalRungeKutta.SnappedTimes(ClassicalRungeKutta.Of(new QuadraticDrag(K), V(0, -Gravity)), V(0, Height), E, step,
            (int)(Seconds / step));
        yield return BounceRow(step, snapped) with { Note = "contacts moved to the end of their step" };
        (Vector3D x, _) = ClassicalRungeKutta.Run(ClassicalRungeKutta.ThesisStep, ClassicalRungeKutta.Of(new QuadraticDrag(K), V(0, -Gravity)), default,
            default, step, 128);
        yield return FallRow(step, 4, x.Y) with { Note = "the thesis's update of the position" };
    }

    private HardRow FallRow(HardContext context, IAcceleration drag, double step)
    {
        const double end = 4;
        Scene scene = new SceneBuilder("fall").AddForce(Force.Supplied(drag)).AddBody("ball", Stepped(step), default).Build();
        return FallRow(step, end, Read(context.Run(scene, end), 0, end).Position.Y);
    }

    private HardRow FallRow(double step, double end, double y)
    {
        (double place, double speed) = LocalErrors(step, Terminal);
        double exact = -Terminal * Terminal / Gravity * Math.Log(Math.Cosh(Gravity * end / Terminal));
        return new HardRow(
            Name, FormattableString.Invariant($"falls {end} s, step 1/{1 / step:0} s"), Math.Abs(y - exact), "position_m",
            (place * end) + (0.5 * speed * end * end) + (40 * Math.Abs(exact) * Rounding.Unit * end / step),
            "Lotkin's local errors 73/720 M L^4 h^5 a step, M = 2g, L = 2k u (u the terminal speed), added with nothing damped; 40 roundings a step",
            "y = -(u^2/g) ln cosh(g t/u)");
    }

    private static double[] Bounces(HardContext context, IAcceleration drag, double step)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, V(0, -0.5)).AddForce(Force.Supplied(drag))
            .AddBody("ball", Stepped(step, e: E), V(0, Height)).Build();
        return ImpactTimes(context.Run(scene, Seconds), First);
    }

    private HardRow BounceRow(double step, double[] seen)
    {
        double t = 0, up = 0, worst = 0, bound = 0, rise = Height;
        ErrorSources off = new();
        foreach (double impact in seen)
        {
            // Closed forms: up to the apex, and down from it.
            double apex = Terminal / Gravity * Math.Atan(up / Terminal);
            rise += Terminal * Terminal / (2 * Gravity) * Math.Log(1 + (up * up / (Terminal * Terminal)));
            double grown = Math.Exp(Gravity * rise / (Terminal * Terminal));
            double fall = Terminal / Gravity * Math.Acosh(grown);
            double before = Terminal * Math.Sqrt(1 - (1 / (grown * grown)));
            double flight = apex + fall;
            t += flight;
            worst = Math.Max(worst, Math.Abs(impact - t));

            (double place, double speed) = LocalErrors(step, Math.Max(before, up));
            double turn = up > 0 ? K * Math.Pow(Gravity * step, 2) * step : 0;
            double start = -Gravity - (K * up * up), end = -Gravity + (K * before * before), after = -Gravity - (K * E * E * before * before);
            off.Fly(up, start, -before, end);

            // The quintic through both ends of the contact's step: (h/2)^6/720 of the sixth derivative of x, at most M L^4.
            double steep = 2 * K * Math.Max(before, up), quintic = 2 * Gravity * Math.Pow(steep, 4) * Math.Pow(step / 2, 6) / 720;
            off.Add((turn * flight) + (place * flight) + (0.5 * speed * flight * flight) + (40 * rise * Rounding.Unit * flight / step) + quintic, 0);
            off.Add(0, turn + (speed * flight));
            bound = Math.Max(bound, off.Delay(before) + Rounding.Tick);
            off.Bounce(E, -before, end, after);
            (up, rise) = (E * before, 0);
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{seen.Length} bounces, step 1/{1 / step:0} s"), seen.Length >= 4 ? worst : double.NaN, "time_s", bound,
            "Lotkin's local errors, k (gh)^2 h where the speed changes sign, (h/2)^6/720 of the quintic at a contact, passed on by each contact's saltation, over the speed; and a tick",
            "atan and ln up, acosh and exp down, hop by hop");
    }

    /// <summary>Of place and speed, a second, up to that speed.</summary>
    private static (double Place, double Speed) LocalErrors(double step, double speed)
    {
        double most = Gravity + (K * speed * speed), steep = Math.Max(2 * K * speed, Math.Sqrt(2 * K * most));
        double local = 73.0 / 720 * most * Math.Pow(steep, 3) * Math.Pow(step, 4);
        return (local, local * steep);
    }
}
