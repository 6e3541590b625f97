using System;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Drag in proportion to the square of the speed, falling and bouncing, against tanh and ln cosh, bounce by bounce.</summary>
/// <remarks>
/// On v' = f(v) the classical method's local error is at most 73/720 M L^4 h^5 (Lotkin 1951, also Ralston 1962), where |f| is at most M,
/// |f'| at most L and |f''| at most L^2/M; one L less for the place, the integral. Where the speed changes sign f'' jumps: that step is off
/// by at most k (gh)^2 h. Drag only ever damps an error of the speed.
/// </remarks>
internal sealed class QuadraticDragCase : DragCase
{
    private const double K = 0.02; // per metre

    private static readonly QuadraticDragFall Fall = new(Gravity, K);

    public override string Name => "drag-quadratic";

    public override string Title => "quadratic drag, falling and bouncing, by every law";

    protected override double Height => 5;

    protected override double BounceSeconds => 8;

    protected override (double Fall, double Bounces) Wrong => (1e-3, 1e-2);

    protected override string FallReference => "y = -(u^2/g) ln cosh(g t/u)";

    protected override string BounceReference => "atan and ln up, acosh and exp down, hop by hop";

    protected override (string Fall, string Bounces) StepArguments => (
        "Lotkin's local errors 73/720 M L^4 h^5 a step, M = 2g, L = 2k u (u the terminal speed), added with nothing damped",
        "Lotkin's local errors, k (gh)^2 h where the speed changes sign, (h/2)^6/720 of the quintic at a contact");

    protected override bool HasClosedForm => false;

    protected override Force Drag(double factor) => Force.QuadraticDrag("drag", K * factor);

    protected override double Depth(double seconds) => Fall.Fallen(seconds);

    protected override double Acceleration(double v) => -Gravity - (K * v * Math.Abs(v));

    protected override Hop Next(double height, double up)
    {
        (double seconds, double speed) = Fall.Landing(height, up);
        return new Hop(seconds, up, speed);
    }

    protected override double StepError(double step, double seconds)
    {
        (double place, double speed) = LocalErrors(step, Fall.Terminal);
        return (place * seconds) + (0.5 * speed * seconds * seconds);
    }

    protected override (double Place, double Speed) StepErrors(double step, Hop hop)
    {
        (double place, double speed) = LocalErrors(step, Math.Max(hop.Speed, hop.Up));
        double turn = hop.Up > 0 ? K * Math.Pow(Gravity * step, 2) * step : 0, t = hop.Seconds;

        // The quintic through both ends of the contact's step: (h/2)^6/720 of the sixth derivative of x, at most M L^4.
        double steep = 2 * K * Math.Max(hop.Speed, hop.Up), quintic = 2 * Gravity * Math.Pow(steep, 4) * Math.Pow(step / 2, 6) / 720;
        return ((turn * t) + (place * t) + (0.5 * speed * t * t) + quintic, turn + (speed * t));
    }

    /// <summary>Returns the error in position and speed per second, up to a speed.</summary>
    private static (double Place, double Speed) LocalErrors(double step, double speed)
    {
        double most = Gravity + (K * speed * speed), steep = Math.Max(2 * K * speed, Math.Sqrt(2 * K * most));
        double local = 73.0 / 720 * most * Math.Pow(steep, 3) * Math.Pow(step, 4);
        return (local, local * steep);
    }
}
