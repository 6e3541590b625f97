using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Crowding: bodies that meet again and again on the spot are solved together with all they nearly touch.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// From this many impacts on, each soon after the one before, a body is crowded: what it nearly touches takes part in its
    /// impacts, if they are in lasting contact. Without it a light body that carries a heavy one would carry it as a gas of one particle does, by
    /// ever faster impacts: some thousand times the square root of the mass ratio a second.
    /// </summary>
    private const int CrowdedAfter = 8;

    /// <summary>
    /// From this many on what is nearer than the scene's resolution takes part whether or not it lasts: the body is squeezed, and what goes on in
    /// such a gap is not followed any further.
    /// </summary>
    internal const int SqueezedAfter = 64;

    /// <summary>In a crowd of more bodies than these the load is passed on impact by impact: to solve all together costs the cube of their number.</summary>
    private const int MostCrowded = 8;

    /// <summary>By how many hops' speeds a plastic impact may change velocities, in the mean by mass, of bodies in lasting contact.</summary>
    private const double LastingHops = 4;

    /// <summary>How soon after the one before an impact must come to crowd: half of a hop's time under the earth's gravity.</summary>
    private static readonly SimDuration CrowdedWithin = SimDuration.FromTicks(1L << 29);

    /// <summary>Solves impacts one by one however crowded bodies are: only a test's negative control sets it.</summary>
    internal bool IgnoresCrowding { get; set; }

    /// <summary>Of the impact at hand: whether something takes part that nothing strikes.</summary>
    private bool hasNear;

    /// <summary>In the gather at hand: from what count on a body's near ones take part.</summary>
    private int nearFrom;

    /// <summary>In the gather at hand: how near is near.</summary>
    private double reach;

    /// <summary>Whether, in the gather at hand, so many take part with near ones among them that it has to be made anew without those.</summary>
    private bool IsTooCrowded => hasNear && partyCount > MostCrowded && nearFrom == CrowdedAfter;

    private double NearGap => HopHeight * Scene.Resolution;

    /// <summary>The speed of a hop of a thousand resolutions under this acceleration.</summary>
    private double HopSpeed(double acceleration) => Math.Sqrt(2 * acceleration * NearGap);

    /// <summary>
    /// How many impacts in succession a body will have had with one at <paramref name="time"/>, each soon after the one before, counted no further than to <see
    /// cref="SqueezedAfter"/>. A function of its newest segment, so that a timeline that was cut counts again as it did.
    /// </summary>
    private int CrowdingAt(int slot, SimTime time) => CrowdingAfter(timelines.Last(slot), time);

    private int CrowdingAfter(int segment, SimTime time)
    {
        ref readonly EventKey opened = ref timelines.Key(segment);
        int more = opened.Kind == EventKind.Impact ? 1 : 0; // else it is carried on, where slipping or rolling has turned a little
        return time - opened.Time <= CrowdedWithin ? Math.Min(timelines.Segment(segment).Crowding + more, SqueezedAfter) : 0;
    }

    /// <summary>Whether a crowded body is so near to a static surface that it does not strike now that the surface takes part.</summary>
    private bool IsNearSurface(int slot, int count, int surface, SimTime time)
    {
        int last = timelines.Last(slot);
        bool isPlane = surface < Scene.PlaneArray.Length;
        if (count < nearFrom || IsHeld(last) || (isPlane && timelines.Segment(last).Supports.Contains(surface)))
        {
            return false; // a support takes part anyway, and nothing static stops a hand
        }

        return SurfaceGap(slot, surface, time) <= reach;
    }

    /// <summary>The distance between a body's surface and a static one at a tick.</summary>
    private double SurfaceGap(int slot, int surface, SimTime time)
    {
        Vector3D position = PositionAt(timelines.Last(slot), time);
        double radius = bodies[slot].Spec.Radius;
        if (surface < Scene.PlaneArray.Length)
        {
            return Scene.PlaneArray[surface].Gap(position, radius);
        }

        ref readonly StaticSphere sphere = ref Scene.SphereArray[surface - Scene.PlaneArray.Length];
        return (position - sphere.Centre).Length - (radius + sphere.Radius);
    }

    /// <summary>Whether two bodies of which one is crowded are so near that the other takes part, though they do not strike now.</summary>
    private bool IsNearBody(int slot, int count, int other, int piece, SimTime time)
    {
        int mine = timelines.Last(slot);
        if ((count < nearFrom && CrowdingAfter(piece, time) < nearFrom) || (IsHeld(mine) && IsHeld(piece)))
        {
            return false;
        }

        double gap = Gap(slot, mine, other, piece, time);
        bool isPushed = IsHeld(mine) || IsHeld(piece);
        return gap <= reach && !(isPushed && IsThrough(gap, timelines.Segment(IsHeld(mine) ? piece : mine).Crowding));
    }

    /// <summary>The distance between two bodies' surfaces at a tick, on these pieces of their paths; the same bits whoever asks.</summary>
    private double Gap(int slot, int piece, int other, int otherPiece, SimTime time) =>
        Scene.Box.Nearest(PositionAt(piece, time) - PositionAt(otherPiece, time)).Length - (bodies[slot].Spec.Radius + bodies[other].Spec.Radius);

    /// <summary>
    /// Whether the parties are in lasting contact: a plastic impact would change their velocities, in the mean by mass, by no more than a few
    /// hops' speed. Whoever sees it, and however fast they slide along each other; and a light one may rattle among heavy ones as it likes.
    /// </summary>
    private bool IsLasting()
    {
        for (int i = 0; i < contactCount; i++)
        {
            contacts[i].Normal = NormalOf(contacts[i]);
            contacts[i].Target = 0;
        }

        partyVelocities.AsSpan(0, partyCount).CopyTo(partyTrial);
        int gathered = contactCount;
        AddSupports();
        solver.Solve(contacts.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyTrial.AsSpan(0, partyCount));
        contactCount = gathered;
        double mass = 0;
        double square = 0;
        double pressing = Scene.Gravity.Length;
        for (int i = 0; i < partyCount; i++)
        {
            if (double.IsPositiveInfinity(partyMasses[i]))
            {
                continue; // a hand keeps its velocity
            }

            mass += partyMasses[i];
            square += ((partyTrial[i] - partyVelocities[i]).LengthSquared - square) * (partyMasses[i] / mass);
            pressing = Math.Max(pressing, partyAccelerations[i].Length);
        }

        return square <= LastingHops * LastingHops * 2 * pressing * NearGap;
    }
}
