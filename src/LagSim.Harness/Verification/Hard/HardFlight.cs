using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>How a body of 1 kg flies in a hard case under the scene's first force: by which law, and how exactly. Immutable.</summary>
/// <param name="Law">The law.</param>
/// <param name="Step">The length of its steps in seconds; zero where they follow from the tolerance.</param>
/// <param name="Tolerance">What a step or piece may be off by, in metres and m/s.</param>
internal readonly record struct HardFlight(MotionLaw Law, double Step, double Tolerance)
{
    /// <summary>Of a state in a step or piece: 31, to which the quintic's coefficients magnify one, and 9 for the rest.</summary>
    internal const int RoundingsAPiece = 40;

    /// <summary>Whence <see cref="ErrorOf"/> is.</summary>
    internal string Argument => (Law == MotionLaw.ClosedForm ? "the tolerance once" : "the tolerance for each step") + "; 40 roundings a piece";

    /// <summary>What it is in a table.</summary>
    internal string Text => Law switch
    {
        MotionLaw.RungeKutta4 => FormattableString.Invariant($"step 1/{1 / Step:0} s"),
        MotionLaw.ClosedForm => FormattableString.Invariant($"closed form, tolerance {ShortTolerance}"),
        _ => FormattableString.Invariant($"Dormand-Prince, tolerance {ShortTolerance}"),
    };

    private string ShortTolerance => Tolerance.ToString(Tolerance > 0 ? "0.#e0" : "0", System.Globalization.CultureInfo.InvariantCulture);

    /// <summary>Fixed steps of the classical Runge-Kutta method.</summary>
    internal static HardFlight Steps(double seconds) => new(MotionLaw.RungeKutta4, seconds, 0);

    /// <summary>The closed form, with pieces as long as that tolerance lets them be.</summary>
    internal static HardFlight Closed(double tolerance) => new(MotionLaw.ClosedForm, 0, tolerance);

    /// <summary>Dormand and Prince's method under error control.</summary>
    internal static HardFlight Controlled(double tolerance) => new(MotionLaw.DormandPrince54, 0, tolerance);

    /// <summary>A ball that flies so.</summary>
    internal BodySpec Ball(double radius = 0.5, double e = 1) =>
        new(radius, 1, e, Law, Step > 0 ? SimDuration.FromSeconds(Step) : null, ForceSet.Of(0), Tolerance);

    /// <summary>
    /// How far, in metres and m/s each, so many pieces may leave a path in all, before what the motion makes of it: under error control the
    /// tolerance each, as estimated of the lower of the two orders; in closed form the tolerance once, where a piece is looked at between
    /// its ends. And roundings.
    /// </summary>
    internal double ErrorOf(int pieces, double size) =>
        (Law == MotionLaw.DormandPrince54 ? pieces * Tolerance : Tolerance) + (RoundingsAPiece * Rounding.Unit * size * pieces);

}
