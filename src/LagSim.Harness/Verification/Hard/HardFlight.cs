using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The flight of a body of 1 kg in a hard case under the scene's first force: its law, and its accuracy. Immutable.</summary>
/// <param name="Law">The law.</param>
/// <param name="Step">The length of its steps, in seconds; zero where they follow from the tolerance.</param>
/// <param name="Tolerance">The tolerance of a step or segment, in metres and m/s.</param>
internal readonly record struct HardFlight(MotionLaw Law, double Step, double Tolerance)
{
    /// <summary>
    /// The roundings of a state in a step or segment: 31, by which the quintic's coefficients magnify one, and 9 for the rest.
    /// </summary>
    internal const int RoundingsAPiece = 40;

    /// <summary>The derivation of <see cref="ErrorOf"/>.</summary>
    internal string Argument => (Law == MotionLaw.ClosedForm ? "the tolerance once" : "the tolerance for each step") + "; 40 roundings a piece";

    /// <summary>The name in a table.</summary>
    internal string Text => Law switch
    {
        MotionLaw.RungeKutta4 => FormattableString.Invariant($"step 1/{1 / Step:0} s"),
        MotionLaw.ClosedForm => FormattableString.Invariant($"closed form, tolerance {ShortTolerance}"),
        _ => FormattableString.Invariant($"Dormand-Prince, tolerance {ShortTolerance}"),
    };

    private string ShortTolerance => Tolerance.ToString(Tolerance > 0 ? "0.#e0" : "0", System.Globalization.CultureInfo.InvariantCulture);

    /// <summary>Fixed steps of the classical Runge-Kutta method.</summary>
    internal static HardFlight Steps(double seconds) => new(MotionLaw.RungeKutta4, seconds, 0);

    /// <summary>The closed form, with segments as long as the tolerance allows.</summary>
    internal static HardFlight Closed(double tolerance) => new(MotionLaw.ClosedForm, 0, tolerance);

    /// <summary>Dormand and Prince's method under error control.</summary>
    internal static HardFlight Controlled(double tolerance) => new(MotionLaw.DormandPrince54, 0, tolerance);

    /// <summary>Returns a ball with this flight.</summary>
    internal BodySpec Ball(double radius = 0.5, double e = 1) =>
        new(radius, 1, e, Law, Step > 0 ? SimDuration.FromSeconds(Step) : null, ForceSet.Of(0), Tolerance);

    /// <summary>
    /// Returns the error, in metres and m/s each, of a number of segments together, before the motion propagates it. Under error control it
    /// is the tolerance for each, as estimated for the lower of the two orders; in closed form it is the tolerance once, where a segment is
    /// sampled between its ends. Roundings are added.
    /// </summary>
    internal double ErrorOf(int pieces, double size) =>
        (Law == MotionLaw.DormandPrince54 ? pieces * Tolerance : Tolerance) + (RoundingsAPiece * Rounding.Unit * size * pieces);

}
