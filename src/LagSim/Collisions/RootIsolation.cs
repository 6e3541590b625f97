using System;

namespace LagSim.Collisions;

/// <summary>Finds when a polynomial gap is first touching or overlapping, and closing.</summary>
/// <remarks>
/// Roots are isolated in the Bernstein basis: a polynomial has no more roots in an interval than its Bernstein coefficients change sign
/// (variation diminishing), and halving by de Casteljau's scheme only averages, which is numerically benign. An interval with one change
/// holds exactly one root, which Newton's method with bisection as its guard then refines. A double root, a graze, is no event.
/// </remarks>
internal static class RootIsolation
{
    /// <summary>The highest degree: the squared distance of two quintic paths.</summary>
    internal const int MaxDegree = 10;

    private const int MaxHalvings = 60;
    private const int MaxRefinements = 100;

    /// <summary>
    /// The least t in [0, <paramref name="length"/>] at which f &lt;= 0 while f falls; NaN if there is none. Overlapping and closing at 0
    /// is 0; touching without speed but pressing (f = f' = 0 > f'' where the first derivative that is not zero is negative) is closing;
    /// overlapping and opening is left alone until f falls again.
    /// </summary>
    /// <param name="f">Coefficients by ascending power; is overwritten.</param>
    /// <param name="length">The length of the interval, above zero and finite.</param>
    internal static double Find(Span<double> f, double length)
    {
        double shift = 0;
        if (f[0] <= 0)
        {
            if (FallsFromZero(f.Slice(1)))
            {
                return 0;
            }

            Span<double> derivative = stackalloc double[MaxDegree + 1];
            derivative = derivative.Slice(0, f.Length - 1);
            for (int i = 0; i < derivative.Length; i++)
            {
                derivative[i] = f[i + 1] * (i + 1);
            }

            shift = FirstRootFromAbove(derivative, length);
            if (double.IsNaN(shift) || shift >= length)
            {
                return double.NaN;
            }

            if (Value(f, shift) <= 0)
            {
                return shift;
            }

            Shift(f, shift);
        }

        return shift + FirstRootFromAbove(f, length - shift);
    }

    /// <summary>Whether a function with these derivatives (as power coefficients, from the first on) falls just after 0.</summary>
    private static bool FallsFromZero(Span<double> coefficients)
    {
        foreach (double c in coefficients)
        {
            if (c != 0)
            {
                return c < 0;
            }
        }

        return false;
    }

    /// <summary>The first root at which f, at or above zero at 0, goes below zero; NaN if there is none in (0, length].</summary>
    private static double FirstRootFromAbove(Span<double> f, double length)
    {
        Span<double> bernstein = stackalloc double[MaxDegree + 1];
        int degree = f.Length - 1;
        bernstein = bernstein.Slice(0, degree + 1);

        // Power coefficients on [0, 1], then b_i = sum over k <= i of C(i,k)/C(n,k) c_k, in place by the triangular scheme.
        double scale = 1;
        double binomial = 1;
        for (int k = 0; k <= degree; k++)
        {
            bernstein[k] = f[k] * scale / binomial;
            scale *= length;
            binomial = binomial * (degree - k) / (k + 1);
        }

        for (int round = 1; round <= degree; round++)
        {
            for (int i = degree; i >= round; i--)
            {
                bernstein[i] += bernstein[i - 1];
            }
        }

        return Isolate(f, bernstein, 0, length, 0);
    }

    private static double Isolate(Span<double> f, Span<double> bernstein, double low, double width, int halvings)
    {
        int changes = 0;
        bool above = true;
        foreach (double b in bernstein)
        {
            if (b != 0 && (b > 0) != above)
            {
                above = !above;
                changes++;
            }
        }

        if (changes == 0)
        {
            return double.NaN;
        }

        if (changes == 1)
        {
            return Refine(f, low, low + width);
        }

        if (halvings == MaxHalvings)
        {
            return double.NaN; // a graze: both roots within 2^-60 of the interval
        }

        int n = bernstein.Length;
        Span<double> left = stackalloc double[MaxDegree + 1];
        Span<double> right = stackalloc double[MaxDegree + 1];
        left = left.Slice(0, n);
        right = right.Slice(0, n);
        bernstein.CopyTo(right);
        for (int round = 0; round < n; round++)
        {
            left[round] = right[0];
            for (int i = 0; i < n - 1 - round; i++)
            {
                right[i] = 0.5 * (right[i] + right[i + 1]);
            }
        }

        double half = 0.5 * width;
        double root = Isolate(f, left, low, half, halvings + 1);
        if (!double.IsNaN(root))
        {
            return root;
        }

        // Rounding may have hidden the descent exactly at the middle.
        return right[0] < 0 ? low + half : Isolate(f, right, low + half, half, halvings + 1);
    }

    /// <summary>Newton's method inside a bracket [low, high] with f(low) >= 0 >= f(high); bisection where Newton leaves it.</summary>
    private static double Refine(Span<double> f, double low, double high)
    {
        double t = 0.5 * (low + high);
        for (int i = 0; i < MaxRefinements; i++)
        {
            double value = 0;
            double slope = 0;
            for (int k = f.Length - 1; k >= 0; k--)
            {
                slope = (slope * t) + value;
                value = (value * t) + f[k];
            }

            if (value > 0)
            {
                low = t;
            }
            else
            {
                high = t;
            }

            double next = t - (value / slope);
            if (!(next > low && next < high))
            {
                next = 0.5 * (low + high);
            }

            if (next == t || !(low < high) || next == low || next == high)
            {
                return next;
            }

            t = next;
        }

        return t;
    }

    private static double Value(Span<double> f, double t)
    {
        double value = 0;
        for (int k = f.Length - 1; k >= 0; k--)
        {
            value = (value * t) + f[k];
        }

        return value;
    }

    /// <summary>Taylor shift: f(t) becomes f(t + by), by repeated synthetic division.</summary>
    private static void Shift(Span<double> f, double by)
    {
        for (int round = 0; round < f.Length - 1; round++)
        {
            for (int k = f.Length - 2; k >= round; k--)
            {
                f[k] += by * f[k + 1];
            }
        }
    }
}
