using System;

namespace LagSim.Testing.Links;

/// <summary>The quantile function of the standard normal distribution: the value that a given share of draws does not exceed.</summary>
/// <remarks>
/// Wichura's algorithm AS 241 (Applied Statistics 37, 1988), without its last branch: good to about 16 digits for shares within 1e-10 of 0
/// or 1.
/// </remarks>
internal static class NormalQuantile
{
    private static readonly double[] CentreAbove =
    [
        3.3871328727963666080, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
        4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3,
    ];

    private static readonly double[] CentreBelow =
    [
        1, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
        2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4, 5.2264952788528545610e3,
    ];

    private static readonly double[] TailAbove =
    [
        1.42343711074968357734, 4.63033784615654529590, 5.76949722146069140550, 3.64784832476320460504,
        1.27045825245236838258, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4,
    ];

    private static readonly double[] TailBelow =
    [
        1, 2.05319162663775882187, 1.67638483018380384940, 6.89767334985100004550e-1,
        1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9,
    ];

    /// <summary>The quantile of a share between 1e-10 and 1 - 1e-10.</summary>
    internal static double Of(double share)
    {
        double fromMedian = share - 0.5;
        if (Math.Abs(fromMedian) <= 0.425)
        {
            double inside = 0.180625 - (fromMedian * fromMedian);
            return fromMedian * Polynomial(CentreAbove, inside) / Polynomial(CentreBelow, inside);
        }

        double beyond = Math.Sqrt(-Math.Log(fromMedian < 0 ? share : 1 - share)) - 1.6;
        return Math.Sign(fromMedian) * Polynomial(TailAbove, beyond) / Polynomial(TailBelow, beyond);
    }

    private static double Polynomial(double[] coefficients, double x)
    {
        double sum = 0;
        for (int n = coefficients.Length - 1; n >= 0; n--)
        {
            sum = (sum * x) + coefficients[n];
        }

        return sum;
    }
}
