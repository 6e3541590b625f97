using System;
using System.Collections.Generic;

namespace LagSim.Harness.Reports.Charts;

/// <summary>Thins a long series for drawing. The lowest and the highest value of each bucket stay, so no peak is lost.</summary>
internal static class Decimation
{
    /// <summary>About as many points as a plot of 900 pixels can show.</summary>
    internal const int MaxPoints = 2000;

    /// <summary>
    /// Returns the points to draw, in order; y is NaN where the line breaks. At most about <paramref name="maxPoints"/>; gaps add to it,
    /// but never more than three points a bucket.
    /// </summary>
    internal static List<(double X, double Y)> Thin(double[] x, double[] y, int maxPoints = MaxPoints)
    {
        List<(double X, double Y)> points = [];
        int buckets = Math.Max(1, maxPoints / 2);
        long n = x.Length;
        if (n <= maxPoints)
        {
            Copy(x, y, points);
            return points;
        }

        int drawn = -1; // the index of the last point kept
        for (int bucket = 0; bucket < buckets; bucket++)
        {
            int from = (int)(bucket * n / buckets), to = (int)((bucket + 1) * n / buckets);
            int low = -1, high = -1;
            for (int i = from; i < to; i++)
            {
                if (!double.IsNaN(y[i]))
                {
                    low = low < 0 || y[i] < y[low] ? i : low;
                    high = high < 0 || y[i] > y[high] ? i : high;
                }
            }

            if (bucket == 0)
            {
                Keep(0, x, y, points, ref drawn);
            }

            if (low >= 0)
            {
                Keep(Math.Min(low, high), x, y, points, ref drawn);
                Keep(Math.Max(low, high), x, y, points, ref drawn);
            }
        }

        Keep((int)n - 1, x, y, points, ref drawn);
        return points;
    }

    private static void Copy(double[] x, double[] y, List<(double X, double Y)> points)
    {
        for (int i = 0; i < x.Length; i++)
        {
            points.Add((x[i], y[i]));
        }
    }

    /// <summary>Adds a point, and before it a break if the series has one since the last point kept.</summary>
    private static void Keep(int index, double[] x, double[] y, List<(double X, double Y)> points, ref int drawn)
    {
        if (index <= drawn)
        {
            return;
        }

        for (int i = drawn + 1; i < index; i++)
        {
            if (double.IsNaN(y[i]))
            {
                points.Add((x[i], double.NaN));
                break;
            }
        }

        points.Add((x[index], y[index]));
        drawn = index;
    }
}
