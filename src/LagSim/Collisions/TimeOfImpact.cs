using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Collisions;

/// <summary>When two paths touch: a pure function of two immutable segments and the instant from which both hold.</summary>
/// <remarks>
/// It knows no "now", no order of queries and no broad phase. The two moving bodies come ordered by identity, so that operand order is the
/// same on every peer. An event is reported only where the gap is at or below zero and closing; see <see cref="RootIsolation"/>.
/// </remarks>
internal static class TimeOfImpact
{
    /// <summary>How many terms a path has at most: a quintic.</summary>
    internal const int PathLength = 6;

    /// <summary>The first contact of a moving sphere with a static plane in [from, until].</summary>
    internal static bool WithPlane(
        in MotionSegment segment, in DenseOutput dense, double radius, in StaticPlane plane, SimTime from, SimTime until, out ContactTime contact)
    {
        double root = segment.IsDense
            ? OfQuintic(segment, dense, radius, plane, from, Seconds(from, until))
            : OfParabola(segment.Position, segment.Velocity, segment.Acceleration * 0.5, from.SecondsSince(segment.Epoch), radius, plane);
        return ContactTime.TryMake(from, until, root, out contact);
    }

    private static double OfParabola(Vector3D place, Vector3D speed, in Vector3D half, double since, double radius, in StaticPlane plane)
    {
        Shift(ref place, ref speed, half, since);
        return Quadratic.FirstDescent(plane.Gap(place, radius), Vector3D.Dot(plane.Normal, speed), Vector3D.Dot(plane.Normal, half));
    }

    private static double OfQuintic(in MotionSegment segment, in DenseOutput dense, double radius, in StaticPlane plane, SimTime from, double seconds)
    {
        Span<Vector3D> path = stackalloc Vector3D[PathLength];
        Span<double> gap = stackalloc double[PathLength];
        int length = Path(segment, dense, from, path);
        gap[0] = plane.Gap(path[0], radius);
        for (int i = 1; i < length; i++)
        {
            gap[i] = Vector3D.Dot(plane.Normal, path[i]);
        }

        return RootIsolation.Find(gap.Slice(0, length), seconds);
    }

    /// <summary>The first contact of two spheres in [from, until]; <paramref name="reach"/> is the sum of their radii.</summary>
    internal static bool WithSphere(
        in MotionSegment a, in DenseOutput denseA, in MotionSegment b, in DenseOutput denseB, double reach, SimTime from, SimTime until,
        out ContactTime contact)
    {
        if (!a.IsDense && !b.IsDense && a.Acceleration == b.Acceleration)
        {
            return OfParabolas(
                a.Position, a.Velocity, from.SecondsSince(a.Epoch), b.Position, b.Velocity, from.SecondsSince(b.Epoch), a.Acceleration, reach,
                from, until, out contact);
        }

        Span<Vector3D> d = stackalloc Vector3D[PathLength];
        Span<Vector3D> other = stackalloc Vector3D[PathLength];
        int length = Math.Max(Path(a, denseA, from, d), Path(b, denseB, from, other));
        for (int i = 0; i < length; i++)
        {
            d[i] -= other[i];
        }

        while (length > 1 && d[length - 1] == Vector3D.Zero)
        {
            length--;
        }

        double root = length switch
        {
            1 => double.NaN, // the same motion: the distance never changes
            2 => Linear(d[0], d[1], reach),
            _ => Curved(d.Slice(0, length), reach, Seconds(from, until)),
        };
        return ContactTime.TryMake(from, until, root, out contact);
    }

    /// <summary>
    /// The first contact of two parabolas of one acceleration, given by their states some seconds before <paramref name="from"/>: the
    /// result of the general way, to the bit.
    /// </summary>
    internal static bool OfParabolas(
        in Vector3D positionA, in Vector3D velocityA, double sinceA, in Vector3D positionB, in Vector3D velocityB, double sinceB, in Vector3D acceleration,
        double reach, SimTime from, SimTime until, out ContactTime contact)
    {
        Vector3D half = acceleration * 0.5;
        Vector3D place = positionA;
        Vector3D speed = velocityA;
        Shift(ref place, ref speed, half, sinceA);
        Vector3D otherPlace = positionB;
        Vector3D otherSpeed = velocityB;
        Shift(ref otherPlace, ref otherSpeed, half, sinceB);
        Vector3D opening = speed - otherSpeed;
        double root = opening == Vector3D.Zero ? double.NaN : Linear(place - otherPlace, opening, reach);
        return ContactTime.TryMake(from, until, root, out contact);
    }

    /// <summary>
    /// When a moving point next leaves a sphere, in [from, until]; at once where it is outside and moves outward.
    /// </summary>
    internal static bool OutOfSphere(
        in MotionSegment segment, in DenseOutput dense, in MotionSegment centre, in DenseOutput denseCentre, double reach, SimTime from,
        SimTime until, out ContactTime contact)
    {
        Span<Vector3D> d = stackalloc Vector3D[PathLength];
        Span<Vector3D> other = stackalloc Vector3D[PathLength];
        int length = Math.Max(Path(segment, dense, from, d), Path(centre, denseCentre, from, other));
        for (int i = 0; i < length; i++)
        {
            d[i] -= other[i];
        }

        while (length > 1 && d[length - 1] == Vector3D.Zero)
        {
            length--;
        }

        double root = length switch
        {
            1 => double.NaN,
            2 => LinearOut(d[0], d[1], reach),
            _ => Curved(d.Slice(0, length), reach, Seconds(from, until), sign: -1),
        };
        return ContactTime.TryMake(from, until, root, out contact);
    }

    private static void Shift(ref Vector3D position, ref Vector3D velocity, in Vector3D half, double by)
    {
        if (by != 0)
        {
            Vector3D gain = half * by;
            velocity += gain;
            position += velocity * by;
            velocity += gain;
        }
    }

    /// <summary>
    /// Relative motion along a straight line: a quadratic whose discriminant is taken from the cross product, exact near a graze.
    /// </summary>
    private static double Linear(in Vector3D d, in Vector3D v, double reach)
    {
        double c = (Vector3D.Dot(d, d)) - (reach * reach);
        double b = Vector3D.Dot(d, v);
        if (c <= 0)
        {
            return b < 0 ? 0 : double.NaN;
        }

        double speedSquared = Vector3D.Dot(v, v);
        double discriminant = (speedSquared * reach * reach) - Vector3D.Cross(d, v).LengthSquared;
        return b < 0 && discriminant > 0 ? c / (Math.Sqrt(discriminant) - b) : double.NaN;
    }

    /// <summary>
    /// The way out of a sphere along a straight line. What is outside already, by rounding, and moves inward, passes through it; if it
    /// misses it, it is outside from where it comes nearest.
    /// </summary>
    private static double LinearOut(in Vector3D d, in Vector3D v, double reach)
    {
        double c = (Vector3D.Dot(d, d)) - (reach * reach);
        double b = Vector3D.Dot(d, v);
        double speedSquared = Vector3D.Dot(v, v);
        if (c >= 0 && b > 0)
        {
            return 0;
        }

        double discriminant = (speedSquared * reach * reach) - Vector3D.Cross(d, v).LengthSquared;
        double root = Math.Sqrt(Math.Max(0, discriminant));
        return b > 0 ? -c / (b + root) : (root - b) / speedSquared;
    }

    /// <summary>
    /// Any other relative motion: the squared distance is a polynomial, searched in windows of doubling length. The sign tells which way:
    /// 1 for what comes nearer, -1 for what goes further away.
    /// </summary>
    private static double Curved(Span<Vector3D> d, double reach, double seconds, double sign = 1)
    {
        Span<double> f = stackalloc double[RootIsolation.MaxDegree + 1];
        double start = 0;
        double window = Math.Min(seconds, 1);
        while (true)
        {
            int terms = SquaredDistance(d, reach, f);
            for (int k = 0; k < terms && sign < 0; k++)
            {
                f[k] = -f[k];
            }

            if (OnlyGrows(f, terms))
            {
                return double.NaN; // as when one body has fallen away from one that does not fall for some seconds: the end of time is far
            }

            double root = RootIsolation.Find(f.Slice(0, terms), window);
            if (!double.IsNaN(root))
            {
                return start + root;
            }

            start += window;
            if (start >= seconds)
            {
                return double.NaN;
            }

            Shift(d, window);
            window = Math.Min(start, seconds - start);
        }
    }

    /// <summary>Whether the two are apart, and no term of their distance ever brings them nearer.</summary>
    internal static bool OnlyGrows(Span<double> f, int terms)
    {
        bool grows = f[0] > 0;
        for (int k = 1; k < terms && grows; k++)
        {
            grows = f[k] >= 0;
        }

        return grows;
    }

    private static int SquaredDistance(Span<Vector3D> d, double reach, Span<double> f)
    {
        int terms = (2 * d.Length) - 1;
        for (int k = 0; k < terms; k++)
        {
            double sum = 0;
            for (int i = Math.Max(0, k - d.Length + 1); i <= Math.Min(k, d.Length - 1); i++)
            {
                sum += Vector3D.Dot(d[i], d[k - i]);
            }

            f[k] = sum;
        }

        f[0] -= reach * reach;
        return terms;
    }

    /// <summary>The path as a polynomial in the seconds after <paramref name="from"/>; returns how many coefficients it has.</summary>
    internal static int Path(in MotionSegment segment, in DenseOutput dense, SimTime from, Span<Vector3D> path)
    {
        path[0] = segment.Position;
        path[1] = segment.Velocity;
        path[2] = segment.Acceleration * 0.5;
        int length = 3;
        if (segment.IsDense)
        {
            path[3] = dense.Cubic;
            path[4] = dense.Quartic;
            path[5] = dense.Quintic;
            length = PathLength;
        }

        double shift = from.SecondsSince(segment.Epoch);
        if (shift != 0)
        {
            Shift(path.Slice(0, length), shift);
        }

        return length;
    }

    private static void Shift(Span<Vector3D> path, double by)
    {
        for (int round = 0; round < path.Length - 1; round++)
        {
            for (int k = path.Length - 2; k >= round; k--)
            {
                path[k] += path[k + 1] * by;
            }
        }
    }

    /// <summary>The seconds between two times. No end means the end of time: 2^23 s is more than any instant is away.</summary>
    internal static double Seconds(SimTime from, SimTime until) =>
        until == SimTime.MaxValue ? 8388608.0 : until.SecondsSince(from);
}
