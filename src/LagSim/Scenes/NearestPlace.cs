using System;

namespace LagSim.Scenes;

/// <summary>The nearest place for a ball that is outside of the static geometry that stops it.</summary>
/// <remarks>
/// <para>Outside of a plane is a half-space, and outside of a static sphere is at least the half-space beyond a tangent plane. The nearest
/// point of half-spaces is found as an LP-type problem (Sharir and Welzl 1992): to a basis, of three planes at most, comes the plane that it
/// leaves the ball in most deeply, and the nearest point of those four gives the next basis. Each is further off than the one before, so it
/// ends. The tangents of spheres are those at the nearest place outside of the planes. So among planes, and beside one sphere alone, it is
/// the nearest place there is; beside several there may be a nearer one.</para>
/// <para>Pure and immutable. Cost: the surfaces of the scene, times the few that push.</para>
/// </remarks>
internal sealed class NearestPlace(StaticSurfaces surfaces)
{
    /// <summary>
    /// The sine of the least angle between two planes, and between the edge of two and a third, that are not taken for parallel: an edge is
    /// a million radii away at most.
    /// </summary>
    private const double LeastSine = 1e-6;

    /// <summary>Finds the place; false if the half-spaces have no point in common, so that there is none between these surfaces.</summary>
    /// <param name="position">Where the ball's centre is.</param>
    /// <param name="radius">Its radius.</param>
    /// <param name="filter">What it collides with.</param>
    /// <param name="place">Where its centre is put: where it is, if it is outside but for rounding. If there is none, where planes alone
    /// would have it.</param>
    internal bool TryFind(in Vector3D position, double radius, CollisionFilter filter, out Vector3D place)
    {
        bool isFound = TryFindWay(position, position, radius, filter, surfaces.Planes, out Vector3D way);
        place = position + way;
        if (isFound && surfaces.Planes < surfaces.Count)
        {
            isFound = TryFindWay(position, place, radius, filter, surfaces.Count, out way);
            place = isFound ? position + way : place;
        }

        return isFound;
    }

    /// <summary>The shortest way out of the half-spaces of the first surfaces, those of spheres by their tangents towards a point.</summary>
    private bool TryFindWay(in Vector3D position, in Vector3D tangentAt, double radius, CollisionFilter filter, int count, out Vector3D way)
    {
        way = default;
        Basis basis = default;
        double rounding = 1e-15 * (position.Taxicab + radius);
        for (double length = 0; TryFindDeepest(position, tangentAt, radius, filter, count, way, rounding, out HalfSpace deepest);)
        {
            if (!basis.TryJoin(deepest, rounding, out way))
            {
                return false;
            }

            if (way.Length <= length)
            {
                break; // no further off than before: what is left is rounding
            }

            length = way.Length;
        }

        return true;
    }

    /// <summary>Which half-space a way leaves the ball in most deeply, if by more than rounding.</summary>
    private bool TryFindDeepest(
        in Vector3D position, in Vector3D tangentAt, double radius, CollisionFilter filter, int count, in Vector3D way, double rounding,
        out HalfSpace deepest)
    {
        double least = rounding + (1e-14 * way.Length); // as what joins a basis is asked for: so no half-space of it joins again
        double depth = least;
        deepest = default;
        for (int surface = 0; surface < count; surface++)
        {
            if (!filter.CollidesWith(surfaces.Filter(surface)))
            {
                continue;
            }

            Vector3D normal = surfaces.Normal(surface, tangentAt);
            double needed = surfaces.IsPlane(surface)
                ? -surfaces.Gap(surface, position, radius)
                : Vector3D.Dot(normal, tangentAt - position) - surfaces.Gap(surface, tangentAt, radius);
            double left = needed - Vector3D.Dot(normal, way);
            if (left > depth)
            {
                (depth, deepest) = (left, new HalfSpace(normal, needed));
            }
        }

        return depth > least;
    }

    /// <summary>What is outside of a plane: ways that go at least so far along its normal.</summary>
    private readonly struct HalfSpace(Vector3D normal, double needed)
    {
        internal readonly Vector3D Normal = normal;
        internal readonly double Needed = needed;
    }

    /// <summary>The half-spaces, three at most, whose planes the shortest way out ends on.</summary>
    private struct Basis
    {
        private HalfSpace first, second, third;
        private int count;

        /// <summary>One more half-space joins, in which the way ends so far: the basis and the way of all four.</summary>
        /// <returns>False if they have no point in common.</returns>
        internal bool TryJoin(in HalfSpace joining, double slack, out Vector3D way)
        {
            Span<HalfSpace> all = stackalloc HalfSpace[4] { joining, first, second, third };
            all = all.Slice(0, count + 1);
            for (int size = 1; size <= 3; size++)
            {
                for (int b = 1; b <= (size == 1 ? 1 : all.Length - 1); b++)
                {
                    for (int c = b + 1; c <= (size < 3 ? b + 1 : all.Length - 1); c++)
                    {
                        if (TryMeet(all, size, b, c, out way) && IsIn(all, way, slack))
                        {
                            (first, second, third, count) = (joining, size > 1 ? all[b] : default, size > 2 ? all[c] : default, size);
                            return true;
                        }
                    }
                }
            }

            way = default;
            return false;
        }

        private static bool IsIn(Span<HalfSpace> all, in Vector3D way, double slack)
        {
            bool isIn = true;
            foreach (ref readonly HalfSpace half in all)
            {
                isIn &= Vector3D.Dot(half.Normal, way) >= half.Needed - slack - (1e-14 * way.Length);
            }

            return isIn;
        }

        /// <summary>
        /// The shortest way to where the planes of the first half-space and of others meet, if each of them pushes: by a QR decomposition of
        /// their normals, which keeps its figures where planes are all but parallel.
        /// </summary>
        private static bool TryMeet(Span<HalfSpace> all, int size, int second, int third, out Vector3D way)
        {
            (Vector3D a, double alongA) = (all[0].Normal, all[0].Needed);
            way = a * alongA;
            if (size == 1)
            {
                return true;
            }

            Vector3D b = all[second].Normal;
            double cosine = Vector3D.Dot(a, b);
            Vector3D across = b - (a * cosine);
            if (across.Length <= LeastSine)
            {
                return false;
            }

            across = across.Direction;
            across = (across - (a * Vector3D.Dot(a, across))).Direction; // once more, since what was left of b may be little
            double sine = Vector3D.Dot(across, b);
            double alongB = (all[second].Needed - (cosine * alongA)) / sine;
            way += across * alongB;
            if (size == 2)
            {
                double pushB = alongB / sine;
                return pushB >= 0 && alongA - (cosine * pushB) >= 0;
            }

            Vector3D c = all[third].Normal;
            Vector3D outside = Vector3D.Cross(a, across);
            (double onA, double onB, double onC) = (Vector3D.Dot(a, c), Vector3D.Dot(across, c), Vector3D.Dot(outside, c));
            double alongC = (all[third].Needed - (onA * alongA) - (onB * alongB)) / onC;
            way += outside * alongC;
            double pushOfC = alongC / onC;
            double pushOfB = (alongB - (onB * pushOfC)) / sine;
            return Math.Abs(onC) > LeastSine && pushOfC >= 0 && pushOfB >= 0
                && alongA - (cosine * pushOfB) - (onA * pushOfC) >= 0;
        }
    }
}
