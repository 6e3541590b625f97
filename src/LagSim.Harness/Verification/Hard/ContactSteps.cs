using System;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// The guarantees of a contact tolerance d for bodies in persistent contact, and how to read their steps. The bounds of such bodies are
/// derived from this.
/// </summary>
/// <remarks>
/// A step h is the largest power of two of seconds in which a fall from rest stays within d, so g h^2 / 2 is at most d, and the chord of a
/// step is at most d / 4 from its parabola. A member's velocity is that of the middle of its step: read within a step it is off by up to a
/// h / 2, and at a tick the mean of both sides is off by the second order only. Sweeps leave a contact to close by 0.005 d in a step, and
/// impacts within one by 0.05 d, which the next step corrects, so a contact that holds still is off by twice that.
/// </remarks>
internal static class ContactSteps
{
    /// <summary>
    /// The fraction of d by which a contact may be off that is left to close by 0.05 d in a step, and corrected in the next.
    /// </summary>
    internal const double Closing = 0.1;

    /// <summary>The fraction of d by which sweeps leave a contact to close, or to slip, in a step.</summary>
    internal const double Sweep = 0.005;

    /// <summary>Returns the length of a step at a tolerance, in seconds.</summary>
    internal static double Step(double tolerance, double pull = Gravity)
    {
        double step = 1.0 / 64;
        while (step * step * pull > 2 * tolerance)
        {
            step /= 2;
        }

        return step;
    }

    /// <summary>Returns the least tolerance at which steps have a given length: the measured order is that of the step.</summary>
    internal static double ToleranceOf(double step, double pull = Gravity) => pull * step * step / 2 * (1 + 1e-9);

    /// <summary>Returns the tick at or before a time.</summary>
    internal static double TickBefore(double seconds, double step) => Math.Floor(seconds / step) * step;

    /// <summary>
    /// Returns a body at a tick, with the mean of its values in the steps before and after, if it was in steps on both sides.
    /// </summary>
    internal static BodyState AtTick(Simulation simulation, int body, double tick, double step)
    {
        BodyState before = Read(simulation, body, tick - (step / 2)), after = Read(simulation, body, tick);
        return before.Motion != MotionLaw.Constrained || after.Motion != MotionLaw.Constrained ? after
            : new BodyState(after.Position, (before.Velocity + after.Velocity) * 0.5, after.Motion, (before.Spin + after.Spin) * 0.5);
    }

    /// <summary>The reason why a control with the same steps at both tolerances fails: its order is 0.</summary>
    internal const string SameSteps = "the tolerance does not reach the steps";

    /// <summary>Checks that errors fall with the step as they should: measured between two steps.</summary>
    internal static HardRow Order(
        string name, string size, double coarse, double fine, double ratio, double expected, double share, string argument)
    {
        double order = Math.Log(coarse / fine) / Math.Log(ratio);
        return new HardRow(
            name, FormattableString.Invariant($"{size}, d over {ratio * ratio:0}"), Math.Abs(order - expected),
            FormattableString.Invariant($"order_off_{expected:0.##}"), share, argument, "order in the step, of which d goes with the"
                + " square")
        {
            Note = FormattableString.Invariant($"measured order {order:0.000}"),
        };
    }
}
