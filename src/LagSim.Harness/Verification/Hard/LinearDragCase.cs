using System;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Drag in proportion to the speed, falling and bouncing, against exponentials.</summary>
/// <remarks>
/// The velocity obeys v' = k (u - v), with u the terminal one. The classical method multiplies v - u by R(-kh) a step, R(z) = 1 + z + z^2/2
/// + z^3/6 + z^4/24, and conserves x + (v - ut)/k, as it does every linear invariant. So its own error is known exactly, without contacts;
/// a contact propagates errors by its saltation.
/// </remarks>
internal sealed class LinearDragCase : DragCase
{
    private const double K = 0.5;

    private static readonly LinearDragFall Fall = new(Gravity, K);
    private static readonly double Terminal = Fall.Terminal;

    public override string Name => "drag-linear";

    public override string Title => "linear drag, falling and bouncing, by every law";

    protected override double Height => 2;

    protected override double BounceSeconds => 6;

    protected override (double Fall, double Bounces) Wrong => (1e-3, 1e-3);

    protected override string FallReference => "y = u t - (u/k)(1 - exp(-kt))";

    protected override string BounceReference => "exponentials, hop by hop; the roots by bisection";

    protected override (string Fall, string Bounces) StepArguments => (
        "what the method itself leaves, |u|/k |R(-kh)^n - exp(-knh)|",
        "local errors (kh)^5/120 |v - u| a step and (h/2)^6/720 of the quintic at each contact");

    protected override bool HasClosedForm => true;

    protected override Force Drag(double factor) => Force.LinearDrag("drag", K * factor);

    protected override double Depth(double seconds) => -Fall.Height(0, 0, seconds);

    protected override double Acceleration(double v) => -Gravity - (K * v);

    protected override Hop Next(double height, double up)
    {
        double seconds = Fall.Landing(height, up);
        return new Hop(seconds, up, -Fall.Speed(up, seconds));
    }

    protected override double StepError(double step, double seconds) =>
        Math.Abs(Terminal) / K * Math.Abs(Math.Pow(Stability(-K * step), seconds / step) - Math.Exp(-K * seconds));

    protected override (double Place, double Speed) StepErrors(double step, Hop hop)
    {
        // The flight adds the method's local errors z^5/120 |v - u| a step and decays what was there before; x is off by as much over k.
        double rate = Math.Pow(K, 5) * Math.Pow(step, 4) / 120 * Math.Abs(Terminal - hop.Up) * (1 + (K * step));

        // The contact is found on the quintic through both ends of its step, whose own error is (h/2)^6/720 of the sixth derivative of x.
        double quintic = Math.Pow(K, 5) * Math.Abs(Terminal - hop.Up) * Math.Pow(step / 2, 6) / 720;
        return ((rate / K * hop.Seconds) + (rate * hop.Seconds * hop.Seconds) + quintic, rate * hop.Seconds);
    }

    private static double Stability(double z) => 1 + (z * (1 + (z / 2 * (1 + (z / 3 * (1 + (z / 4)))))));
}
