using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>When a body's newest segment next meets a static surface or another's path.</summary>
/// <remarks>
/// A pure function of the segments, with the two bodies ordered by identity. It does not depend on the time of day, on which body asks
/// first, or on other queries. Of an instant before the edge of the history, whose segments may be gone, it gives what it gave when they
/// were there.
/// </remarks>
internal sealed class CollisionPredictor(
    Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, MemberContacts members, StrikeCounts strikes,
    ContactScale scale, EventWork work, bool hasIslands)
{
    /// <summary>
    /// The first round of an instant in which there can be a collapse: a contact is struck, then something else strikes one of the two, a
    /// round later, and only then can they close again. Rounds are numbered from 0.
    /// </summary>
    internal const uint CollapseRound = 2;

    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly PeriodicBox box = scene.Box;
    private readonly double restitutionThreshold = scene.RestitutionThreshold;
    private readonly Paths paths = new(timelines);

    /// <summary>The next contact of a body's newest segment with a static surface: planes by index, static spheres after them.</summary>
    internal bool TryTouchSurface(int slot, int surface, out ContactTime contact, out uint round)
    {
        int last = timelines.Last(slot);
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        contact = default;
        round = 0;
        bool isPlane = surfaces.IsPlane(surface);
        if (segment.Law is MotionLaw.Resting or MotionLaw.Held || (isPlane && segment.Supports.Contains(surface)) || !filters.MeetSurface(last, surface))
        {
            return false; // the surface that carries a body stays below it until another event, and nothing static stops a hand
        }

        if (segment.Law == MotionLaw.Constrained && (members.IsOutOfReach(slot, segment, surface) || members.IsCovered(last, surface)))
        {
            return false;
        }

        SimTime opened = timelines.Key(last).Time;
        SimTime from = opened;
        if (segment.Epoch < opened && TouchSurface(slot, last, surface, isPlane, segment.Epoch, out contact) && contact.Tick > opened)
        {
            // A path taken over from an event that came late: solved from its beginning, the root has the bits that it has on other peers.
            return true;
        }

        while (TouchSurface(slot, last, surface, isPlane, from, out contact))
        {
            if (contact.Tick != opened && contact.IsSoonAfter(opened) && ClosesAtOnce(slot, last, surface, opened))
            {
                contact = ContactTime.At(opened);
            }

            round = paths.RoundAfter(last, contact.Tick);
            if (contact.Tick != opened)
            {
                return true;
            }

            Vector3D position = paths.PositionAt(last, contact);
            double radius = bodies.Spec(slot).Radius;
            Vector3D normal = surfaces.Normal(surface, position);
            Vector3D velocity = paths.VelocityAt(last, contact);
            double reach = surfaces.Reach(surface, radius);
            double pressing = -Vector3D.Dot(normal, paths.AccelerationAt(last, contact)) - FallingAway(normal, velocity, reach);
            Closing closing = new(
                -Vector3D.Dot(normal, velocity), pressing, velocity.Length,
                surfaces.Gap(surface, position, radius), RoundingOf(position, radius));
            bool isElastic = Math.Min(bodies.Spec(slot).Restitution, surfaces.Restitution(surface)) >= 1;
            SimDuration wait = WaitFor(closing, segment.IsOfIsland && members.Holds(last, surface), isElastic);
            if (wait < ContactTime.Soon
                && !MayWait(closing, opened, closing.Speed <= StrikeCounts.CollapseSpeed ? strikes.On(last, surface, opened) : 0, round))
            {
                return true;
            }

            from = Recheck(opened, segment.End, wait);
            if (from == SimTime.MaxValue)
            {
                return false;
            }
        }

        return false;
    }

    private bool TouchSurface(int slot, int last, int surface, bool isPlane, SimTime from, out ContactTime contact)
    {
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        if (isPlane)
        {
            return TimeOfImpact.WithPlane(
                segment, timelines.Dense(last), bodies.Spec(slot).Radius, surfaces.Plane(surface), from, segment.End, out contact);
        }

        ref readonly StaticSphere sphere = ref surfaces.Sphere(surface);
        return TimeOfImpact.WithSphere(
            segment, timelines.Dense(last), MotionSegment.AtRest(start, sphere.Centre), default, bodies.Spec(slot).Radius + sphere.Radius,
            from, segment.End, out contact);
    }

    /// <summary>Whether a body's newest segment surely does not touch a segment of another body until some time.</summary>
    internal bool StayApart(int slot, int other, int piece, SimTime until)
    {
        int mine = timelines.Last(slot);
        SimTime from = SimTime.Max(timelines.Key(mine).Time, timelines.Key(piece).Time);
        return !box.Exists
            && (until < from
                || PathSeparation.AreApart(
                    timelines.Segment(mine), timelines.Dense(mine), timelines.Segment(piece), timelines.Dense(piece),
                    bodies.Spec(slot).Radius + bodies.Spec(other).Radius + scale.Length, from, until));
    }

    /// <summary>
    /// The next contact of a body's newest segment with a segment of another body; a pure function of the two, ordered by identity.
    /// </summary>
    internal bool TryTouchBody(int slot, int other, int piece, out ContactTime contact, out uint round)
    {
        contact = default;
        round = 0;
        work.CountTest();
        int mine = timelines.Last(slot);
        if (slot == other || !timelines.Segment(piece).IsPresent || !timelines.Segment(mine).IsPresent)
        {
            return false;
        }

        if (!filters.Meet(mine, piece))
        {
            return false;
        }

        bool ordered = bodies.Id(slot) < bodies.Id(other);
        int a = ordered ? slot : other;
        int b = ordered ? other : slot;
        int lastA = ordered ? mine : piece;
        int lastB = ordered ? piece : mine;
        ref readonly MotionSegment segmentA = ref timelines.Segment(lastA);
        scoped ref readonly MotionSegment segmentB = ref timelines.Segment(lastB);
        if ((segmentA.Law == MotionLaw.Held && segmentB.Law == MotionLaw.Held) || members.IsCovered(a, lastA, b, lastB))
        {
            return false;
        }

        SimTime opened = SimTime.Max(timelines.Key(lastA).Time, timelines.Key(lastB).Time);
        SimTime until = SimTime.Min(segmentA.End, segmentB.End);
        MotionSegment image;
        if (box.Exists)
        {
            image = NearestImage(segmentB, paths.PositionAt(lastA, opened), paths.PositionAt(lastB, opened));
            segmentB = ref image;
        }

        double reach = bodies.Spec(a).Radius + bodies.Spec(b).Radius;
        if (IsSunkIn(lastA, lastB, reach, opened))
        {
            contact = ContactTime.At(opened);
            round = Math.Max(paths.RoundAfter(lastA, opened), paths.RoundAfter(lastB, opened));
            return true;
        }

        if (segmentA.Law == MotionLaw.Resting && segmentB.Law == MotionLaw.Resting)
        {
            return false;
        }

        SimTime from = opened;
        while (from <= until && TimeOfImpact.WithSphere(
            segmentA, timelines.Dense(lastA), segmentB, timelines.Dense(lastB), reach, from, until, out contact))
        {
            if (contact.Tick != opened && contact.IsSoonAfter(opened) && ClosesAtOnce(lastA, lastB, reach, opened))
            {
                contact = ContactTime.At(opened);
            }

            round = Math.Max(paths.RoundAfter(lastA, contact.Tick), paths.RoundAfter(lastB, contact.Tick));
            if (contact.Tick != opened)
            {
                return true;
            }

            Vector3D position = paths.PositionAt(lastA, contact);
            Vector3D apart = box.Nearest(position - paths.PositionAt(lastB, contact));
            Vector3D normal = apart.Direction;
            Vector3D velocityA = paths.VelocityAt(lastA, contact);
            Vector3D velocityB = paths.VelocityAt(lastB, contact);
            Vector3D velocity = velocityA - velocityB;
            Vector3D acceleration = paths.AccelerationAt(lastA, contact) - paths.AccelerationAt(lastB, contact);
            double pressing = -Vector3D.Dot(normal, acceleration) - FallingAway(normal, velocity, reach);
            Closing closing = new(
                -Vector3D.Dot(normal, velocity), pressing, velocityA.Length + velocityB.Length,
                apart.Length - reach, RoundingOf(position, reach));
            SimDuration wait = WaitFor(
                closing, members.HoldTogether(a, lastA, b, lastB), Math.Min(bodies.Spec(a).Restitution, bodies.Spec(b).Restitution) >= 1);
            if (wait < ContactTime.Soon
                && !MayWait(
                    closing, opened, closing.Speed <= StrikeCounts.CollapseSpeed ? strikes.Between(lastA, lastB, opened) : 0, round))
            {
                return true;
            }

            from = Recheck(opened, until, wait);
            if (from == SimTime.MaxValue)
            {
                return false;
            }
        }

        return false;
    }

    /// <summary>
    /// Whether two bodies are in each other by more than the contact tolerance and part no faster than they would be pushed apart: one was
    /// put there, and a contact step has to push them out. Without islands there are no steps, and nothing pushes against a hand.
    /// </summary>
    private bool IsSunkIn(int first, int second, double reach, SimTime opened)
    {
        if (!hasIslands || paths.IsHeld(first) || paths.IsHeld(second))
        {
            return false;
        }

        ContactTime now = ContactTime.At(opened);
        Vector3D apart = paths.PositionAt(first, now) - paths.PositionAt(second, now);
        double nearest = reach - scale.Length;
        if (!(nearest > 0 && apart.LengthSquared < nearest * nearest))
        {
            return false;
        }

        double length = apart.Length;
        double parting = Vector3D.Dot(apart, paths.VelocityAt(first, now) - paths.VelocityAt(second, now));
        return parting <= length * scale.PartSpeed(reach - length, scale.Step.ToSeconds());
    }

    /// <summary>The image of a path in a periodic box that is nearest to a point when the path is at <paramref name="at"/>.</summary>
    private MotionSegment NearestImage(in MotionSegment path, in Vector3D point, in Vector3D at) =>
        path.At(path.Position + (box.Nearest(at - point) - (at - point)));

    /// <summary>
    /// How long the search for a contact that closes from the opening of its segments on can wait. It closes so slowly, as rounding leaves
    /// it, or a step's sweeps where it holds, that it uses up its room only then. An elastic contact has what is left of that room, because
    /// no step makes up for what its impacts leave. If that is sooner than <see cref="ContactTime.Soon"/> it may have to be struck at once.
    /// </summary>
    private SimDuration WaitFor(in Closing closing, bool holds, bool isElastic)
    {
        double room = 2 * closing.Room(restitutionThreshold);
        room = !holds ? room : isElastic ? Math.Max(room, scale.LookDepth + (2 * Math.Min(0, closing.Gap))) : scale.LookDepth;
        double seconds = UntilDeep(room, closing.Speed, closing.Pressing);
        SimDuration wait = TickConversion.TryFromSeconds(seconds, out long ticks) ? SimDuration.FromTicks(ticks) : SimDuration.MaxValue;
        if (closing.Pressing < 0)
        {
            // It parts by itself, and from then on may come back as fast as it likes; but not before it has parted by more than rounding.
            double apart = Math.Max(-2 * closing.Speed / closing.Pressing, Math.Sqrt(-2 * closing.Rounding / closing.Pressing));
            SimDuration parts = TickConversion.TryFromSeconds(apart, out ticks) ? SimDuration.FromTicks(ticks) : SimDuration.MaxValue;
            parts = parts < ContactTime.Soon ? ContactTime.Soon : parts;
            wait = parts < wait ? parts : wait;
        }

        return wait;
    }

    /// <summary>
    /// When it is searched for again, after such a wait; <see cref="SimTime.MaxValue"/> if the segments end before.
    /// </summary>
    private static SimTime Recheck(SimTime opened, SimTime end, SimDuration wait)
    {
        wait = wait < ContactTime.Soon ? ContactTime.Soon : wait;
        ulong left = unchecked((ulong)(end.Ticks - opened.Ticks)); // which is more than a span can be, where neither ends
        return left < (ulong)wait.Ticks ? SimTime.MaxValue : opened + wait;
    }

    /// <summary>
    /// Whether what closes in the instant in which it was struck may wait: rounding after one impact, and what a collapse has left, or
    /// would have ended if one were possible. In the round of the first collapse it may not, however slow it is: that is what ends it.
    /// An instant before the edge of the history is over, and what still closes there did wait, or it would be on another path. How often
    /// it was struck then may be forgotten, and a world that goes on from a snapshot never knew it.
    /// </summary>
    private bool MayWait(in Closing closing, SimTime opened, int strikes, uint round) =>
        opened < timelines.Edge || (closing.IsRounding ? strikes > 0 : strikes > 1 && round > CollapseRound);

    /// <summary>
    /// Whether a body closes on a surface that is no further off than places are rounded. No path can resolve the instant, so it is this
    /// one.
    /// </summary>
    private bool ClosesAtOnce(int slot, int piece, int surface, SimTime opened)
    {
        ContactTime now = ContactTime.At(opened);
        Vector3D position = paths.PositionAt(piece, now);
        double radius = bodies.Spec(slot).Radius;
        return surfaces.Gap(surface, position, radius) <= RoundingOf(position, radius)
            && Vector3D.Dot(surfaces.Normal(surface, position), paths.VelocityAt(piece, now)) < 0;
    }

    /// <summary>Whether two bodies close that are no further apart than places are rounded.</summary>
    private bool ClosesAtOnce(int first, int second, double reach, SimTime opened)
    {
        ContactTime now = ContactTime.At(opened);
        Vector3D position = paths.PositionAt(first, now);
        Vector3D apart = box.Nearest(position - paths.PositionAt(second, now));
        return apart.Length - reach <= RoundingOf(position, reach)
            && Vector3D.Dot(apart, paths.VelocityAt(first, now) - paths.VelocityAt(second, now)) < 0;
    }

    /// <summary>
    /// The error of a gap because places are rounded, in metres: four roundings of a double, 2^-52 each, of the summed terms.
    /// </summary>
    private static double RoundingOf(in Vector3D position, double reach) =>
        4.0 / (1L << 52) * (position.Taxicab + reach);

    /// <summary>How fast, in m/s², the gap to what is round opens because one slides along it.</summary>
    internal static double FallingAway(in Vector3D normal, in Vector3D velocity, double reach) =>
        (velocity - (normal * Vector3D.Dot(normal, velocity))).LengthSquared / reach;

    /// <summary>The root of u t + a t^2 / 2 = depth / 2; if it eases off by itself, as if it did not.</summary>
    private static double UntilDeep(double depth, double closing, double pressing) =>
        depth / (closing + Math.Sqrt((closing * closing) + (Math.Max(0, pressing) * depth)));
}
