using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Which two of many balls overlap: space is halved until few are left together, and who lies on both sides of a cut is looked at on both.</summary>
/// <remarks>Cost: n log n for balls that fill space; where cuts part nothing, as among balls of all sizes in one place, what sort and sweep costs.</remarks>
internal sealed class OverlapSearch
{
    private const int Few = 32;

    private readonly List<Ball> balls = new();
    private readonly List<int> items = new(); // sets of balls, one behind the other
    private readonly PeriodicBox box;
    private readonly double tolerance;

    /// <summary>A search among the bodies of a scene; how deep in metres two may be in each other, besides rounding.</summary>
    internal OverlapSearch(List<SceneBody> bodies, in PeriodicBox box, double tolerance)
    {
        this.box = box;
        this.tolerance = tolerance;
        double widest = 0;
        foreach (SceneBody body in bodies)
        {
            widest = Math.Max(widest, body.Spec.Radius);
        }

        int images = box.Exists ? 8 : 1;
        for (int image = 0; image < images; image++)
        {
            for (int n = 0; n < bodies.Count; n++)
            {
                AddImage(bodies[n].Position, bodies[n].Spec.Radius, n, image, widest);
            }
        }
    }

    /// <summary>Two bodies that overlap, the one that was added first as the first, and how deep in metres; false if there are none.</summary>
    internal bool TryFind(out int first, out int second, out double depth)
    {
        for (int i = 0; i < balls.Count; i++)
        {
            items.Add(i);
        }

        return TryFind(0, items.Count, out first, out second, out depth);
    }

    /// <summary>In a periodic box who reaches as far as another may over a side is there a second time, a side further; so along each axis.</summary>
    private void AddImage(in Vector3D place, double radius, int body, int image, double widest)
    {
        Vector3D at = place;
        for (int axis = 0; axis < 3; axis++)
        {
            if ((image >> axis & 1) != 0)
            {
                if (Along(place, axis) - radius > 2 * widest)
                {
                    return;
                }

                at += new Vector3D(axis == 0 ? box.Size.X : 0, axis == 1 ? box.Size.Y : 0, axis == 2 ? box.Size.Z : 0);
            }
        }

        balls.Add(new Ball { At = at, Place = place, Radius = radius, Body = body });
    }

    private bool TryFind(int from, int to, out int first, out int second, out double depth)
    {
        int axis = WidestAxis(from, to, out double middle);
        int left = 0;
        int right = 0;
        for (int i = from; i < to; i++)
        {
            (double low, double high) = Extent(items[i], axis);
            left += low <= middle ? 1 : 0;
            right += high >= middle ? 1 : 0;
        }

        int count = to - from;
        if (count <= Few || left == count || right == count || left + right > count + (count / 2))
        {
            return TrySweep(from, to, axis, out first, out second, out depth);
        }

        return TryFindIn(from, to, axis, double.NegativeInfinity, middle, out first, out second, out depth)
            || TryFindIn(from, to, axis, middle, double.PositiveInfinity, out first, out second, out depth);
    }

    private bool TryFindIn(int from, int to, int axis, double least, double most, out int first, out int second, out double depth)
    {
        int start = items.Count;
        for (int i = from; i < to; i++)
        {
            (double low, double high) = Extent(items[i], axis);
            if (low <= most && high >= least)
            {
                items.Add(items[i]);
            }
        }

        bool isFound = TryFind(start, items.Count, out first, out second, out depth);
        items.RemoveRange(start, items.Count - start);
        return isFound;
    }

    /// <summary>Sort and sweep: only those whose extents along the axis overlap are compared.</summary>
    private bool TrySweep(int from, int to, int axis, out int first, out int second, out double depth)
    {
        double[] lows = new double[to - from];
        int[] order = new int[to - from];
        for (int i = from; i < to; i++)
        {
            order[i - from] = items[i];
            lows[i - from] = Extent(items[i], axis).Low;
        }

        Array.Sort(lows, order);
        for (int i = 0; i < order.Length; i++)
        {
            double high = Extent(order[i], axis).High;
            for (int j = i + 1; j < order.Length && lows[j] <= high; j++)
            {
                if (AreDeep(balls[order[i]], balls[order[j]], out depth))
                {
                    first = Math.Min(balls[order[i]].Body, balls[order[j]].Body);
                    second = Math.Max(balls[order[i]].Body, balls[order[j]].Body);
                    return true;
                }
            }
        }

        (first, second, depth) = (0, 0, 0);
        return false;
    }

    private bool AreDeep(in Ball a, in Ball b, out double depth)
    {
        double gap = box.Nearest(a.Place - b.Place).Length - a.Radius - b.Radius;
        double slack = tolerance + (1e-15 * (Size(a.Place) + Size(b.Place) + a.Radius + b.Radius)); // rounding of the given numbers themselves must not count
        depth = -gap;
        return gap < -slack && a.Body != b.Body;
    }

    private int WidestAxis(int from, int to, out double middle)
    {
        int widest = 0;
        double most = -1;
        middle = 0;
        for (int axis = 0; axis < 3; axis++)
        {
            double least = double.MaxValue;
            double greatest = double.MinValue;
            for (int i = from; i < to; i++)
            {
                double at = Along(balls[items[i]].At, axis);
                least = Math.Min(least, at);
                greatest = Math.Max(greatest, at);
            }

            if (greatest - least > most)
            {
                widest = axis;
                most = greatest - least;
                middle = least + (0.5 * most);
            }
        }

        return widest;
    }

    private (double Low, double High) Extent(int ball, int axis)
    {
        double at = Along(balls[ball].At, axis);
        return (at - balls[ball].Radius, at + balls[ball].Radius);
    }

    private static double Along(in Vector3D v, int axis) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;

    private static double Size(in Vector3D v) => Math.Abs(v.X) + Math.Abs(v.Y) + Math.Abs(v.Z);

    private struct Ball
    {
        internal Vector3D At; // it, or an image of it
        internal Vector3D Place;
        internal double Radius;
        internal int Body;
    }
}
