namespace LagSim.Motion;

/// <summary>
/// The functions G0 to G3 of beta and s that solve Kepler's problem for every eccentricity: Gn = sum over k of (-beta)^k s^(n + 2k) / (n +
/// 2k)!.
/// </summary>
/// <remarks>
/// For |beta| s² up to 0.1, where ten terms are more than enough: the next is below 0.1^10 / 22!. Error: 2 units in the last place (tests).
/// G0 = 1 - beta G2 and G1 = s - beta G3 are made of the other two.
/// </remarks>
internal readonly struct UniversalFunctions
{
    private UniversalFunctions(double second, double third)
    {
        Second = second;
        Third = third;
    }

    internal double Second { get; }

    internal double Third { get; }

    internal double Zeroth(double beta) => 1 - (beta * Second);

    internal double First(double s, double beta) => s - (beta * Third);

    internal static UniversalFunctions Of(double beta, double s)
    {
        double z = -beta * s * s;
        double second = 0;
        double third = 0;
        for (int k = 9; k >= 1; k--)
        {
            // Horner's scheme from the smallest term: 1 + z / (3 . 4) (1 + z / (5 . 6) (...)).
            second = z / (((2 * k) + 1) * ((2 * k) + 2)) * (1 + second);
            third = z / (((2 * k) + 2) * ((2 * k) + 3)) * (1 + third);
        }

        return new UniversalFunctions(s * s * 0.5 * (1 + second), s * s * s * (1.0 / 6) * (1 + third));
    }
}
