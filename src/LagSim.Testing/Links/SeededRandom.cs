using System;
using System.Numerics;

namespace LagSim.Testing.Links;

/// <summary>A self-contained random generator: the same seed gives the same bits on every runtime, build and processor.</summary>
/// <remarks>
/// <para>xoshiro256** (Blackman and Vigna), its state filled by SplitMix64. <see cref="Random"/> promises no sequence between versions, and
/// a result that cannot be reproduced cannot be investigated.</para>
/// <para>Only integers, <c>+ - * /</c> and <see cref="Math.Sqrt"/> are used; logarithm and exponential are our own, since those of the
/// platform may differ in their last bits. Not thread-safe: one generator belongs to one thread or one lock.</para>
/// </remarks>
internal sealed class SeededRandom
{
    private const double Ln2 = 0.693147180559945309417232121458;
    private const double Ln2High = 0.693147180369123816490; // its first 32 bits, so that a whole multiple of it is exact
    private const double Ln2Low = 1.90821492927058770002e-10;

    private readonly ulong seed;
    private ulong s0, s1, s2, s3;
    private double spare;
    private bool hasSpare;

    /// <summary>Creates a generator for that seed; every seed is good, zero too.</summary>
    public SeededRandom(ulong seed)
    {
        this.seed = seed;
        ulong state = seed;
        s0 = SplitMix(ref state);
        s1 = SplitMix(ref state);
        s2 = SplitMix(ref state);
        s3 = SplitMix(ref state);
    }

    /// <summary>The next 64 random bits.</summary>
    public ulong NextUInt64()
    {
        ulong result = BitOperations.RotateLeft(s1 * 5, 7) * 9;
        ulong t = s1 << 17;
        s2 ^= s0;
        s3 ^= s1;
        s1 ^= s2;
        s0 ^= s3;
        s2 ^= t;
        s3 = BitOperations.RotateLeft(s3, 45);
        return result;
    }

    /// <summary>Uniform in [0, 1), a multiple of 2^-53.</summary>
    public double NextDouble() => (NextUInt64() >> 11) * (1.0 / (1L << 53));

    /// <summary>Uniform in [<paramref name="low"/>, <paramref name="high"/>).</summary>
    public double NextDouble(double low, double high) => low + ((high - low) * NextDouble());

    /// <summary>Normal with mean 0 and standard deviation 1, by Marsaglia's polar method.</summary>
    public double NextGaussian()
    {
        if (hasSpare)
        {
            hasSpare = false;
            return spare;
        }

        double u, v, s;
        do
        {
            u = (2.0 * NextDouble()) - 1.0;
            v = (2.0 * NextDouble()) - 1.0;
            s = (u * u) + (v * v);
        }
        while (s >= 1.0 || s == 0.0);

        double scale = Math.Sqrt(-2.0 * Log(s) / s);
        spare = v * scale;
        hasSpare = true;
        return u * scale;
    }

    /// <summary>Creates an independent generator for a named purpose.</summary>
    /// <remarks>
    /// Depends only on this generator's seed and <paramref name="stream"/>, not on earlier draws: the order of setup changes nothing, and
    /// one more draw in one stream shifts no other.
    /// </remarks>
    public SeededRandom Fork(ulong stream)
    {
        ulong streamState = ~stream;
        ulong state = seed ^ SplitMix(ref streamState);
        return new SeededRandom(SplitMix(ref state));
    }

    /// <summary>
    /// Natural logarithm of a normal number in (0, 1): ln(m 2^e) = e ln 2 + 2 artanh((m - 1) / (m + 1)), m in [0.5, 1) x sqrt 2.
    /// </summary>
    internal static double Log(double x)
    {
        long bits = BitConverter.DoubleToInt64Bits(x);
        int exponent = (int)(bits >> 52) - 1023;
        double mantissa = BitConverter.Int64BitsToDouble((bits & 0xFFFFFFFFFFFFF) | (1023L << 52));
        if (mantissa > 1.4142135623730951)
        {
            mantissa *= 0.5;
            exponent++;
        }

        double f = (mantissa - 1.0) / (mantissa + 1.0);
        double square = f * f; // at most 0.0295, so the term after 1/21 is below 1e-18
        double sum = 0.0;
        for (int odd = 21; odd >= 1; odd -= 2)
        {
            sum = (sum * square) + (1.0 / odd);
        }

        return (exponent * Ln2) + (2.0 * f * sum);
    }

    /// <summary>
    /// e to that power: 2^k e^r, r within half of ln 2 either way. Zero below -708, infinite above 709, in between to the last bits.
    /// </summary>
    internal static double Exp(double x)
    {
        if (!(x is >= -708 and <= 709))
        {
            return x < 0 ? 0 : x > 0 ? double.PositiveInfinity : x;
        }

        double k = Math.Round(x / Ln2);
        double r = (x - (k * Ln2High)) - (k * Ln2Low);
        double sum = 1.0;
        for (int n = 14; n >= 1; n--)
        {
            sum = 1.0 + (sum * r / n); // r^15 / 15! is below 1e-19
        }

        return sum * BitConverter.Int64BitsToDouble(((long)k + 1022) << 52) * 2; // in two factors, since 2^1024 has no bits of its own
    }

    private static ulong SplitMix(ref ulong state)
    {
        ulong z = state += 0x9E3779B97F4A7C15;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
        return z ^ (z >> 31);
    }
}
