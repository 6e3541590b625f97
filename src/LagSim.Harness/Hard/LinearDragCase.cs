using System;
using System.Collections.Generic;
using LagSim.Harness.Forces;
using LagSim.Scenes;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>Drag in proportion to the speed, falling and bouncing, against exponentials.</summary>
/// <remarks>
/// The velocity obeys v' = k (u - v), u the terminal one. On that the classical method multiplies v - u by R(-kh) a step, R(z) = 1 + z + z^2/2 + z^3/6 +
/// z^4/24, and x + (v - ut)/k is kept, as every linear invariant is. So its own error is known exactly, without contacts; a contact passes errors on by its
/// saltation.
/// </remarks>
internal sealed class LinearDragCase : IHardCase
{
    private const double K = 0.5;
    private const double E = 0.9;
    private const double Height = 2;
    private const double Seconds = 6; // of bouncing

    private static readonly LinearDragFall Fall = new(Gravity, K);
    private static readonly double Terminal = Fall.Terminal;

    public string Name => "drag-linear";

    public string Title => "linear drag, falling and bouncing, on Runge-Kutta steps";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double step in context.Sizes([1.0 / 32], [1.0 / 16, 1.0 / 64, 1.0 / 256]))
        {
            yield return FallRow(context, new LinearDrag(K), step);
            yield return BounceRow(step, Bounces(context, new LinearDrag(K), step));
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const double step = 1.0 / 32;
        yield return FallRow(context, new LinearDrag(K * (1 + 1e-6)), step) with { Note = "k off by a millionth" };
        yield return BounceRow(step, Bounces(context, new LinearDrag(K * (1 + 1e-6)), step)) with { Note = "k off by a millionth" };
        double[] snapped = ClassicalRungeKutta.SnappedTimes(ClassicalRungeKutta.Of(new LinearDrag(K), V(0, -Gravity)), V(0, Height), E, step,
            (int)(Seconds / step));
        yield return BounceRow(step, snapped) with { Note = "contacts moved to the end of their step" };
        (Vector3D x, _) = ClassicalRungeKutta.Run(ClassicalRungeKutta.ThesisStep, ClassicalRungeKutta.Of(new LinearDrag(K), V(0, -Gravity)), default, default,
            step, 128);
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
        double steps = end / step;
        double own = Math.Abs(Terminal) / K * Math.Abs(Math.Pow(Stability(-K * step), steps) - Math.Exp(-K * end));
        return new HardRow(
            Name, FormattableString.Invariant($"falls {end} s, step 1/{1 / step:0} s"), Math.Abs(y - Fall.Height(0, 0, end)), "position_m",
            own + RoundingOf(steps, 40),
            "what the method itself leaves, |u|/k |R(-kh)^n - exp(-knh)|, and 40 roundings a step of some 40 m",
            "y = u t - (u/k)(1 - exp(-kt))");
    }

    private static double[] Bounces(HardContext context, IAcceleration drag, double step)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, V(0, -0.5)).AddForce(Force.Supplied(drag))
            .AddBody("ball", Stepped(step, e: E), V(0, Height)).Build();
        return ImpactTimes(context.Run(scene, Seconds), First);
    }

    private HardRow BounceRow(double step, double[] seen)
    {
        double y = Height, v = 0, t = 0, worst = 0, bound = 0;
        ErrorSources off = new();
        foreach (double impact in seen)
        {
            double flight = Fall.Landing(y, v);
            double before = Fall.Speed(v, flight);
            t += flight;
            worst = Math.Max(worst, Math.Abs(impact - t));

            // The flight adds the method's local errors z^5/120 |v - u| a step and decays what was there before; x is off by as much over k.
            double rate = Math.Pow(K, 5) * Math.Pow(step, 4) / 120 * Math.Abs(Terminal - v) * (1 + (K * step));
            double start = -Gravity - (K * v), end = -Gravity - (K * before), after = -E * before;
            off.Fly(v, start, before, end);

            // The contact is found on the quintic through both ends of its step, whose own error is (h/2)^6/720 of the sixth derivative of x.
            off.Add((rate / K * flight) + (rate * flight * flight) + RoundingOf(flight / step, 40)
                + (Math.Pow(K, 5) * Math.Abs(Terminal - v) * Math.Pow(step / 2, 6) / 720), 0);
            off.Add(0, rate * flight);
            bound = Math.Max(bound, off.Delay(before) + Rounding.Tick);
            off.Bounce(E, before, end, -Gravity - (K * after));
            (y, v) = (0, after);
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{seen.Length} bounces, step 1/{1 / step:0} s"), seen.Length >= 4 ? worst : double.NaN, "time_s", bound,
            "local errors (kh)^5/120 |v - u| a step and (h/2)^6/720 of the quintic at each contact, passed on through the contacts by their saltation, over the speed; and a tick",
            "exponentials, hop by hop; the roots by bisection");
    }

    private static double Stability(double z) => 1 + (z * (1 + (z / 2 * (1 + (z / 3 * (1 + (z / 4)))))));

    private static double RoundingOf(double steps, double metres) => 40 * metres * Rounding.Unit * steps;
}
