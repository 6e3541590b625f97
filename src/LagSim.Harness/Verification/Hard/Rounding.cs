using System;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The two remaining sources of error of an exact method, and their sum: the basis of bounds.</summary>
/// <remarks>
/// An operation on doubles has an error of at most <see cref="Unit"/> of its result, and an rms error of that over the square root of 3, if
/// rounding up and down are equally likely (Higham, Accuracy and Stability of Numerical Algorithms, sections 2.2 and 2.8). The rms of n
/// independent roundings grows with the square root of n, and four times the rms is exceeded once in 16,000.
/// </remarks>
internal static class Rounding
{
    /// <summary>The unit roundoff of a double, 2^-53.</summary>
    internal const double Unit = 1.0 / (1L << 53);

    /// <summary>A tick in seconds, 2^-40.</summary>
    internal const double Tick = 1.0 / (1L << 40);

    /// <summary>
    /// The roundings of a velocity from one contact to the next: to the root, at it, and from it to the tick.
    /// </summary>
    internal const int PerContact = 8;

    /// <summary>Returns four times the rms of a number of roundings of a quantity of size 1.</summary>
    internal static double Walk(double roundings) => 4 * Unit * Math.Sqrt(roundings / 3);
}
