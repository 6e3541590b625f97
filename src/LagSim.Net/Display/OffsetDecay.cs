using System;

namespace LagSim.Net.Display;

/// <summary>
/// The decay of an offset: exp(-t / tau), but never faster than the greatest speed. In closed form, so that frames of any length give the
/// same curve.
/// </summary>
internal static class OffsetDecay
{
    private const double Nothing = 1e-6; // m: a smaller offset is dropped

    /// <summary>The time constant in seconds for an offset of that size in metres.</summary>
    internal static double TimeConstant(DisplayOptions options, double size)
    {
        double part = (size - options.SmallCorrection) / (options.LargeCorrection - options.SmallCorrection);
        double fastest = options.Fastest.ToSeconds();
        return fastest + ((options.Slowest.ToSeconds() - fastest) * Math.Min(Math.Max(part, 0), 1));
    }

    /// <summary>The remaining size in metres after a time in seconds.</summary>
    internal static double After(double size, double timeConstant, double maxSpeed, double seconds)
    {
        double slowBelow = maxSpeed * timeConstant; // where the exponential is as fast as the greatest speed
        if (size > slowBelow)
        {
            double untilThen = (size - slowBelow) / maxSpeed;
            if (seconds <= untilThen)
            {
                return size - (maxSpeed * seconds);
            }

            size = slowBelow;
            seconds -= untilThen;
        }

        double left = size * Math.Exp(-seconds / timeConstant);
        return left > Nothing ? left : 0;
    }
}
