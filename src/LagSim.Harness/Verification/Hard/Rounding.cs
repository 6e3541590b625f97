using System;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The two sources of error that an exact method has left, and what they add up to: what bounds are argued from.</summary>
/// <remarks>
/// An operation on doubles is off by at most <see cref="Unit"/> of its result, and by that over the square root of 3 in the rms, if its
/// rounding is as likely one way as the other (Higham, Accuracy and Stability of Numerical Algorithms, sections 2.2 and 2.8). Of n that are
/// independent the rms grows with the square root of n, and four times the rms is exceeded once in 16,000.
/// </remarks>
internal static class Rounding
{
    /// <summary>The unit roundoff of a double, 2^-53.</summary>
    internal const double Unit = 1.0 / (1L << 53);

    /// <summary>A tick in seconds, 2^-40.</summary>
    internal const double Tick = 1.0 / (1L << 40);

    /// <summary>
    /// The roundings that a velocity goes through from one contact to the next: to the root, at it, and from it to the tick.
    /// </summary>
    internal const int PerContact = 8;

    /// <summary>Four times the rms of so many roundings of a quantity of size 1.</summary>
    internal static double Walk(double roundings) => 4 * Unit * Math.Sqrt(roundings / 3);
}
