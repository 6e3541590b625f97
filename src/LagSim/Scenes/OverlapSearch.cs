using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>
/// Finds which two of many balls overlap. Space is halved until few are left together, and balls on both sides of a cut are tested on both.
/// </summary>
/// <remarks>
/// Cost: n log n for balls that fill space. Where cuts separate nothing, as among balls of all sizes in one place, that of sort and sweep.
/// The two sides of a cut are independent, so another thread may have one. If both find an overlap the lower side's counts, which is what
/// one thread would have found.
/// </remarks>
internal sealed class OverlapSearch
{
    private const int Few = 32;

    private readonly PeriodicBox box;
    private readonly double tolerance;
    private Ball[] balls;
    private int ballCount;

    /// <summary>A search among the bodies of a scene; how deep in metres two may be in each other, besides rounding.</summary>
    internal OverlapSearch(SceneBody[] bodies, in PeriodicBox box, double tolerance)
    {
        this.box = box;
        this.tolerance = tolerance;
        balls = new Ball[bodies.Length];
        double widest = 0;
        for (int n = 0; n < bodies.Length; n++)
        {
            widest = Math.Max(widest, bodies[n].Spec.Radius);
        }

        int images = box.Exists ? 8 : 1;
        for (int image = 0; image < images; image++)
        {
            for (int n = 0; n < bodies.Length; n++)
            {
                AddImage(bodies[n].Position, bodies[n].Spec, n, image, widest);
            }
        }
    }

    /// <summary>Two bodies that overlap, the same two on any number of threads; null if there are none.</summary>
    internal Overlap? Find(int threads = 1)
    {
        List<int> all = new(2 * ballCount); // sets of balls, one behind the other
        for (int i = 0; i < ballCount; i++)
        {
            all.Add(i);
        }

        return Find(all, 0, ballCount, threads);
    }

    /// <summary>
    /// In a periodic box a ball that reaches as far over a side as another may is listed a second time, a side further; so along each axis.
    /// </summary>
    private void AddImage(in Vector3D place, in BodySpec spec, int body, int image, double widest)
    {
        Vector3D at = place;
        for (int axis = 0; axis < 3; axis++)
        {
            if ((image >> axis & 1) != 0)
            {
                if (Along(place, axis) - spec.Radius > 2 * widest)
                {
                    return;
                }

                at += new Vector3D(axis == 0 ? box.Size.X : 0, axis == 1 ? box.Size.Y : 0, axis == 2 ? box.Size.Z : 0);
            }
        }

        if (ballCount == balls.Length)
        {
            Array.Resize(ref balls, Math.Max(4, ballCount * 2));
        }

        balls[ballCount++] = new Ball { At = at, Place = place, Radius = spec.Radius, Filter = spec.Filter, Body = body };
    }

    private Overlap? Find(List<int> items, int from, int to, int threads)
    {
        int axis = WidestAxis(items, from, to, out double middle);
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
            return Sweep(items, from, to, axis);
        }

        return threads > 1 && count >= ParallelPair.MinBodies
            ? FindOnTwoThreads(items, from, to, axis, middle, threads)
            : FindIn(items, from, to, axis, double.NegativeInfinity, middle) ?? FindIn(items, from, to, axis, middle, double.PositiveInfinity);
    }

    private Overlap? FindIn(List<int> items, int from, int to, int axis, double least, double most)
    {
        int start = items.Count;
        Choose(items, from, to, axis, least, most, items);
        Overlap? found = Find(items, start, items.Count, 1);
        items.RemoveRange(start, items.Count - start);
        return found;
    }

    /// <summary>The same; each side has a list of its own.</summary>
    private Overlap? FindOnTwoThreads(List<int> items, int from, int to, int axis, double middle, int threads)
    {
        List<int> lower = new(to - from);
        List<int> upper = new(to - from);
        Choose(items, from, to, axis, double.NegativeInfinity, middle, lower);
        Choose(items, from, to, axis, middle, double.PositiveInfinity, upper);
        Overlap? below = null;
        Overlap? above = null;
        ParallelPair.Do(
            threads, () => below = Find(lower, 0, lower.Count, threads - (threads / 2)), () => above = Find(upper, 0, upper.Count, threads / 2));
        return below ?? above;
    }

    private void Choose(List<int> items, int from, int to, int axis, double least, double most, List<int> into)
    {
        for (int i = from; i < to; i++)
        {
            (double low, double high) = Extent(items[i], axis);
            if (low <= most && high >= least)
            {
                into.Add(items[i]);
            }
        }
    }

    /// <summary>Sort and sweep: only balls with overlapping extents along the axis are compared.</summary>
    private Overlap? Sweep(List<int> items, int from, int to, int axis)
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
                if (AreDeep(balls[order[i]], balls[order[j]], out double depth))
                {
                    int a = balls[order[i]].Body;
                    int b = balls[order[j]].Body;
                    return new Overlap(Math.Min(a, b), Math.Max(a, b), depth);
                }
            }
        }

        return null;
    }

    private bool AreDeep(in Ball a, in Ball b, out double depth)
    {
        double gap = box.Nearest(a.Place - b.Place).Length - a.Radius - b.Radius;
        double slack = tolerance + (1e-15 * (a.Place.Taxicab + b.Place.Taxicab + a.Radius + b.Radius)); // rounding of the given numbers themselves must not count
        depth = -gap;
        return gap < -slack && a.Body != b.Body && a.Filter.CollidesWith(b.Filter);
    }

    private int WidestAxis(List<int> items, int from, int to, out double middle)
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
        ref readonly Ball whole = ref balls[ball];
        double at = Along(whole.At, axis);
        return (at - whole.Radius, at + whole.Radius);
    }

    private static double Along(in Vector3D v, int axis) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;

    private struct Ball
    {
        internal Vector3D At; // it, or an image of it
        internal Vector3D Place;
        internal double Radius;
        internal CollisionFilter Filter;
        internal int Body;
    }
}
