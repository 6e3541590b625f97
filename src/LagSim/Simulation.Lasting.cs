using System;
using LagSim.Contacts;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim;

/// <content>Lasting contact: which of what touches neither opens nor closes.</content>
public sealed partial class Simulation
{
    /// <summary>A contact that opens slower than this, in m/s, may last: a quarter of a hop's speed, at which it would soon be struck again.</summary>
    private double LastingSpeed => 0.25 * HopSpeed(Math.Max(Scene.Gravity.Length, 1));

    /// <summary>One that closes faster than this, in m/s, as a step begins is struck first: else the two would be that much too deep on the way.</summary>
    private double MostClosing => 1e-3 * HopSpeed(Math.Max(Scene.Gravity.Length, 1));

    /// <summary>Whether so fast an opening is that of a contact of which a step is under way: nothing of it closes when it begins.</summary>
    private bool IsCalm(double opening) => opening <= LastingSpeed && opening >= -MostClosing;

    /// <summary>
    /// Whether two bodies on these pieces of their paths are in lasting contact: their island keeps them apart, and nobody looks for an impact of theirs.
    /// </summary>
    private bool Lasts(int slot, int piece, int other, int otherPiece)
    {
        ref readonly MotionSegment a = ref timelines.Segment(piece);
        ref readonly MotionSegment b = ref timelines.Segment(otherPiece);
        return a.IsOfIsland && b.IsOfIsland && timelines.Key(piece) == timelines.Key(otherPiece)
            && AreNear(a.Position, b.Position, bodies[slot].Spec.Radius + bodies[other].Spec.Radius)
            && IsCalm(Opening(a.Position, a.Velocity, b.Position, b.Velocity));
    }

    /// <summary>Whether a body on this piece of its path is in lasting contact with a static surface.</summary>
    private bool Lasts(int slot, int piece, int surface)
    {
        ref readonly MotionSegment path = ref timelines.Segment(piece);
        return path.IsOfIsland && IsNear(path.Position, surface, bodies[slot].Spec.Radius) && IsCalm(Vector3D.Dot(SurfaceNormal(surface, path.Position), path.Velocity));
    }

    private bool AreNear(in Vector3D place, in Vector3D otherPlace, double reach) => (place - otherPlace).Length - reach <= NearGap;

    private static double Opening(in Vector3D place, in Vector3D velocity, in Vector3D otherPlace, in Vector3D otherVelocity) =>
        Vector3D.Dot(Direction(place - otherPlace), velocity - otherVelocity);

    private bool IsNear(in Vector3D place, int surface, double radius)
    {
        if (surface < Scene.PlaneArray.Length)
        {
            return Scene.PlaneArray[surface].Gap(place, radius) <= NearGap;
        }

        ref readonly StaticSphere sphere = ref Scene.SphereArray[surface - Scene.PlaneArray.Length];
        return AreNear(place, sphere.Centre, radius + sphere.Radius);
    }

    /// <summary>Whether a contact of the impact at hand may go on as one that lasts, on which no closed form carries a body.</summary>
    private bool MayLast()
    {
        bool may = false;
        for (int i = 0; i < contactCount && !may; i++)
        {
            may = MayLast(contacts[i], ImpactSolver.Opening(contacts[i], partyVelocities));
        }

        return may;
    }

    private bool MayLast(in ContactPoint c, double opening) =>
        opening <= 2 * LastingSpeed && (!IsSupportable(c) || Friction(c) > 0 || IsRubbed(parties[c.First])) && !AreInFreeFlight(c) && !Scene.Box.Exists && !IgnoresIslands;

    /// <summary>
    /// The lever of rolling resistance of a contact, in metres: the larger of its two bodies', each of which has no more resistance than friction.
    /// </summary>
    private double RollingLever(in ContactPoint c)
    {
        double friction = Friction(c);
        double first = Math.Min(bodies[parties[c.First]].Spec.RollingResistance, friction) * partyRadii[c.First];
        double second = c.Second == ContactPoint.Static ? 0 : Math.Min(bodies[parties[c.Second]].Spec.RollingResistance, friction) * partyRadii[c.Second];
        return Math.Max(first, second);
    }

    /// <summary>Whether two bodies have met in free flight: gravity alone does not press them together, whatever rounding has to say.</summary>
    private bool AreInFreeFlight(in ContactPoint c) =>
        c.Second != ContactPoint.Static && flights.IsFree(parties[c.First]) && flights.IsFree(parties[c.Second]);
}
