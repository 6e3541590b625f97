using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// The cubic, quartic and quintic coefficients of a path whose acceleration is not constant; kept apart so that parabolas do not pay for
/// them.
/// </summary>
internal readonly struct DenseOutput
{
    internal DenseOutput(in Vector3D cubic, in Vector3D quartic, in Vector3D quintic, SimDuration nextStep = default)
    {
        Cubic = cubic;
        Quartic = quartic;
        Quintic = quintic;
        NextStep = nextStep;
    }

    internal Vector3D Cubic { get; }

    internal Vector3D Quartic { get; }

    internal Vector3D Quintic { get; }

    /// <summary>For a step under error control, the proposed length of the next; zero otherwise.</summary>
    internal SimDuration NextStep { get; }

    /// <summary>
    /// The quintic Hermite polynomial of a step: through position, velocity and acceleration at both ends. Its error is h^6 |x^(6)| / 46080
    /// in the position at most.
    /// </summary>
    /// <param name="h">The step in seconds.</param>
    /// <param name="dx">How far the position moves in the step.</param>
    /// <param name="dv">How much the velocity changes in the step.</param>
    /// <param name="v0">The velocity at the start.</param>
    /// <param name="a0">The acceleration at the start.</param>
    /// <param name="a1">The acceleration at the end.</param>
    /// <param name="nextStep">See <see cref="NextStep"/>.</param>
    internal static DenseOutput Between(
        double h, in Vector3D dx, in Vector3D dv, in Vector3D v0, in Vector3D a0, in Vector3D a1, SimDuration nextStep = default)
    {
        // The error at the end of the parabola from the start, scaled to the size of a third derivative.
        Vector3D p = (dx - ((v0 + (a0 * (0.5 * h))) * h)) / (h * h * h);
        Vector3D q = (dv - (a0 * h)) / (h * h);
        Vector3D r = (a1 - a0) / h;
        return new DenseOutput(
            (p * 10) - (q * 4) + (r * 0.5),
            ((q * 7) - (p * 15) - r) / h,
            ((p * 6) - (q * 3) + (r * 0.5)) / (h * h),
            nextStep);
    }

    /// <summary>Whether every coefficient is the same, to the bit.</summary>
    internal bool IsSameAs(in DenseOutput other) =>
        Cubic.Equals(other.Cubic) && Quartic.Equals(other.Quartic) && Quintic.Equals(other.Quintic) && NextStep == other.NextStep;

    internal bool IsFinite => Cubic.IsFinite && Quartic.IsFinite && Quintic.IsFinite;
}
