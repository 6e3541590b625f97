using System;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>
/// Finds which of the planes that a body touches carry it under a constant acceleration, and the acceleration that is left.
/// </summary>
/// <remarks>
/// Frictionless support: the body gets the acceleration nearest to the free one among those that point into no plane. At most three planes
/// push at once in space (Caratheodory), so all subsets of one, two and three are tried in the order of the planes; the first that pushes
/// with each and leaves none violated is the answer.
/// </remarks>
internal static class PlaneSupport
{
    // Of the free acceleration: what lies below it is rounding, and would make a body at rest creep.
    private const double Negligible = 1e-13;

    /// <summary>The planes that carry; none if nothing needs to.</summary>
    internal static SupportSet Solve(
        Span<int> touching, StaticPlane[] planes, in Vector3D free, out Vector3D acceleration)
    {
        double slack = Negligible * free.Length;
        acceleration = free;
        if (Permitted(free, touching, planes, slack))
        {
            return default;
        }

        for (int i = 0; i < touching.Length; i++)
        {
            Vector3D n = planes[touching[i]].Normal;
            Vector3D left = free - (n * Vector3D.Dot(n, free));
            if (Vector3D.Dot(n, free) < 0 && Permitted(left, touching, planes, slack))
            {
                acceleration = Settle(left, slack);
                return new SupportSet(1, touching[i], 0, 0);
            }
        }

        for (int i = 0; i < touching.Length; i++)
        {
            for (int j = i + 1; j < touching.Length; j++)
            {
                Vector3D along = Vector3D.Cross(planes[touching[i]].Normal, planes[touching[j]].Normal);
                double size = along.LengthSquared;
                if (!(size > Negligible))
                {
                    continue;
                }

                Vector3D left = along * (Vector3D.Dot(along, free) / size);
                if (BothPush(planes[touching[i]].Normal, planes[touching[j]].Normal, left - free)
                    && Permitted(left, touching, planes, slack))
                {
                    acceleration = Settle(left, slack);
                    return new SupportSet(2, touching[i], touching[j], 0);
                }
            }
        }

        acceleration = Vector3D.Zero;
        return Corner(touching, planes, free);
    }

    /// <summary>The velocity without what points out of or into the supports; exactly zero in a corner.</summary>
    internal static Vector3D Tangential(in Vector3D velocity, SupportSet supports, StaticPlane[] planes)
    {
        if (supports.Count == 1)
        {
            Vector3D n = planes[supports[0]].Normal;
            return (velocity - (n * Vector3D.Dot(n, velocity))).WithoutNegativeZero();
        }

        if (supports.Count == 2)
        {
            Vector3D along = Vector3D.Cross(planes[supports[0]].Normal, planes[supports[1]].Normal);
            return (along * (Vector3D.Dot(along, velocity) / along.LengthSquared)).WithoutNegativeZero();
        }

        return Vector3D.Zero;
    }

    private static SupportSet Corner(Span<int> touching, StaticPlane[] planes, in Vector3D free)
    {
        for (int i = 0; i < touching.Length; i++)
        {
            for (int j = i + 1; j < touching.Length; j++)
            {
                for (int k = j + 1; k < touching.Length; k++)
                {
                    Vector3D a = planes[touching[i]].Normal, b = planes[touching[j]].Normal, c = planes[touching[k]].Normal;
                    double volume = Vector3D.Dot(a, Vector3D.Cross(b, c));
                    if (Math.Abs(volume) > Negligible
                        && -Vector3D.Dot(free, Vector3D.Cross(b, c)) / volume >= 0
                        && -Vector3D.Dot(free, Vector3D.Cross(c, a)) / volume >= 0
                        && -Vector3D.Dot(free, Vector3D.Cross(a, b)) / volume >= 0)
                    {
                        return new SupportSet(3, touching[i], touching[j], touching[k]);
                    }
                }
            }
        }

        // Only rounding leads here, from planes that are all but parallel: the first ones hold.
        return new SupportSet(
            Math.Min(touching.Length, SupportSet.Most), touching[0], touching.Length > 1 ? touching[1] : 0, touching.Length > 2 ? touching[2] : 0);
    }

    /// <summary>Whether a push is a sum of the two normals with coefficients of at least zero.</summary>
    private static bool BothPush(in Vector3D a, in Vector3D b, in Vector3D push)
    {
        double ab = Vector3D.Dot(a, b);
        double pa = Vector3D.Dot(a, push);
        double pb = Vector3D.Dot(b, push);
        return pa - (ab * pb) >= 0 && pb - (ab * pa) >= 0;
    }

    private static bool Permitted(in Vector3D acceleration, Span<int> touching, StaticPlane[] planes, double slack)
    {
        foreach (int plane in touching)
        {
            if (Vector3D.Dot(planes[plane].Normal, acceleration) < -slack)
            {
                return false;
            }
        }

        return true;
    }

    private static Vector3D Settle(in Vector3D acceleration, double slack) =>
        acceleration.Length <= slack ? Vector3D.Zero : acceleration.WithoutNegativeZero();
}
