using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>Decides which contacts of members are left to their steps, so that no impact is searched for.</summary>
internal sealed class MemberContacts(
    TimelineStore timelines, BodyTable bodies, StaticSurfaces surfaces, ContactScale scale)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Whether a contact that a member's segment carries is left to the step, not to impacts: a surface that the step took into account, or
    /// that an impact by a hand has solved, or that the member does not close on. What a step's solver leaves is an error of the step, and
    /// the next continues from it.
    /// </summary>
    internal bool IsCovered(int piece, int surface)
    {
        int at = timelines.Carried.With(piece, surface);
        if (at == TimelineStore.None)
        {
            return false;
        }

        ref readonly MotionSegment path = ref timelines.Segment(piece);
        return timelines.Key(piece).Kind == EventKind.StepEnd || timelines.Carried.At(at).Solved
            || (timelines.Carried.At(at).Holds && Vector3D.Dot(surfaces.Normal(surface, path.Position), path.Velocity) >= -scale.ImpactSpeed);
    }

    /// <summary>
    /// Whether the impact that opened a segment solved a contact that it carries: one that holds, except an elastic one, which impacts do
    /// not pass over.
    /// </summary>
    private bool IsSolved(int slot, int piece, int contact) =>
        timelines.Key(piece).Kind == EventKind.Impact && timelines.Carried.At(contact).Holds && !IsElastic(slot, timelines.Carried.At(contact));

    /// <summary>Whether a member is surely further from a surface than it gets on its chord.</summary>
    internal bool IsOutOfReach(int slot, in MotionSegment chord, int surface)
    {
        double gap = surfaces.Gap(surface, chord.Position, bodies.Spec(slot).Radius);
        double way = chord.End.SecondsSince(chord.Epoch) * 1.001;
        return gap > 0 && gap * gap > chord.Velocity.LengthSquared * way * way + (scale.Length * scale.Length * 1e-6);
    }

    /// <summary>
    /// The same for two bodies: segments of one step or impact, or segments that do not close where the later one begins.
    /// </summary>
    internal bool IsCovered(int slot, int piece, int other, int otherPiece)
    {
        if (paths.IsHeld(otherPiece))
        {
            (slot, piece, other, otherPiece) = (other, otherPiece, slot, piece);
        }

        if (paths.IsHeld(piece) && paths.IsMember(otherPiece))
        {
            return IsCoveredFromHand(slot, piece, otherPiece);
        }

        if (!paths.IsMember(piece) || !paths.IsMember(otherPiece))
        {
            return false;
        }

        int at = timelines.Carried.With(piece, bodies.Id(other));
        if (at == TimelineStore.None || timelines.Carried.With(otherPiece, bodies.Id(slot)) == TimelineStore.None)
        {
            return AreCrowded(slot, piece, other, otherPiece);
        }

        if (timelines.Key(piece) == timelines.Key(otherPiece) && (timelines.Key(piece).Kind == EventKind.StepEnd || IsSolved(slot, piece, at)))
        {
            return true;
        }

        SimTime opened = SimTime.Max(timelines.Key(piece).Time, timelines.Key(otherPiece).Time);
        Vector3D normal = (paths.PositionAt(piece, opened) - paths.PositionAt(otherPiece, opened)).Direction;
        double opening = Vector3D.Dot(normal, timelines.Segment(piece).Velocity - timelines.Segment(otherPiece).Velocity);
        return timelines.Carried.At(at).Holds && opening >= -scale.ImpactSpeed;
    }

    /// <summary>
    /// Whether two members do not carry each other only because each has as many contacts that are deeper: of a crowd, steps and impacts
    /// take the deepest of each body (<see cref="DeepestContacts"/>). What changes within a step waits for its end; then two whom different
    /// steps have moved are struck, and so come into one.
    /// </summary>
    private bool AreCrowded(int slot, int piece, int other, int otherPiece)
    {
        if (!IsCrowded(piece) || !IsCrowded(otherPiece))
        {
            return false;
        }

        SimTime opened = SimTime.Max(timelines.Key(piece).Time, timelines.Key(otherPiece).Time);
        Vector3D apart = paths.PositionAt(piece, opened) - paths.PositionAt(otherPiece, opened);
        double reach = bodies.Spec(slot).Radius + bodies.Spec(other).Radius - scale.SunkDepth;
        return reach > 0 && apart.LengthSquared < reach * reach
            && (timelines.Key(piece) == timelines.Key(otherPiece)
                || (!(timelines.Key(piece).Kind == EventKind.StepEnd && timelines.Key(otherPiece).Kind == EventKind.StepEnd)
                    && Vector3D.Dot(apart.Direction, timelines.Segment(piece).Velocity - timelines.Segment(otherPiece).Velocity) >= -scale.ImpactSpeed));
    }

    /// <summary>Whether a body is a member that carries as many contacts with others as it keeps in a crowd.</summary>
    internal bool IsCrowded(int piece) => paths.IsMember(piece) && timelines.Carried.BodiesOf(piece) >= DeepestContacts.Kept;

    /// <summary>
    /// The same for a hand, which may speed up, and a member: they close neither where the later segment begins nor where the step ends, or the
    /// hand may give no more in an impact than it will in a step.
    /// </summary>
    private bool IsCoveredFromHand(int hand, int handPiece, int piece)
    {
        int at = timelines.Carried.With(piece, bodies.Id(hand));
        if (at == TimelineStore.None || !timelines.Carried.At(at).Holds)
        {
            return false;
        }

        if (timelines.Key(piece) == timelines.Key(handPiece))
        {
            return true;
        }

        SimTime opened = SimTime.Max(timelines.Key(piece).Time, timelines.Key(handPiece).Time);
        if (HandStrength.BlowLeft(timelines.HoldOf(handPiece), opened) < scale.Step.ToSeconds())
        {
            return true; // it has struck with all that it has: the next step gives more
        }

        SimTime end = SimTime.Min(timelines.Segment(piece).End, timelines.Segment(handPiece).End);
        return end >= opened && OpeningAt(handPiece, piece, opened) >= -scale.ImpactSpeed && OpeningAt(handPiece, piece, end) >= -scale.ImpactSpeed;
    }

    internal bool Holds(int piece, int surface)
    {
        int at = timelines.Carried.With(piece, surface);
        return at != TimelineStore.None && timelines.Carried.At(at).Holds;
    }

    /// <summary>Whether two bodies, of which one may be a hand's, carry a contact that holds them together.</summary>
    internal bool HoldTogether(int slot, int piece, int other, int otherPiece)
    {
        bool isMember = paths.IsMember(piece);
        if (!isMember && !paths.IsMember(otherPiece))
        {
            return false;
        }

        int at = isMember ? timelines.Carried.With(piece, bodies.Id(other)) : timelines.Carried.With(otherPiece, bodies.Id(slot));
        return at != TimelineStore.None && timelines.Carried.At(at).Holds;
    }

    private double OpeningAt(int piece, int otherPiece, SimTime time)
    {
        Vector3D velocity = timelines.Segment(piece).VelocityAt(paths.SecondsInto(piece, time), timelines.Dense(piece))
            - timelines.Segment(otherPiece).VelocityAt(paths.SecondsInto(otherPiece, time), timelines.Dense(otherPiece));
        return Vector3D.Dot((paths.PositionAt(piece, time) - paths.PositionAt(otherPiece, time)).Direction, velocity);
    }

    /// <summary>Whether a contact that a body carries is elastic.</summary>
    internal bool IsElastic(int slot, in PersistentContact contact)
    {
        int partner = contact.Surface == PersistentContact.NoSurface ? bodies.SlotOf(contact.Partner) : -1;
        double other = contact.Surface != PersistentContact.NoSurface ? surfaces.Restitution(contact.Surface)
            : partner >= 0 ? bodies.Spec(partner).Restitution : 0;
        return Math.Min(bodies.Spec(slot).Restitution, other) >= 1;
    }
}
