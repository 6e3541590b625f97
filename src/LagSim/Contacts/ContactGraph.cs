using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Contacts;

/// <summary>
/// The bodies and contacts of one event, an impact or a contact step, in canonical order, with the states in which they meet.
/// </summary>
/// <remarks>
/// Bodies are numbered within the graph; each has a place in every span of states. A graph is filled, solved and cleared again and again:
/// it allocates only when an event has more bodies or contacts than any before.
/// </remarks>
internal sealed class ContactGraph(BodyTable bodies, TimelineStore timelines, StaticSurfaces surfaces, PeriodicBox box)
{
    private readonly Paths paths = new(timelines);
    private readonly GraphBodies numbered = new(bodies);
    private readonly GraphContacts contacts = new();
    private double[] masses = new double[2]; // as many as nearly all impacts have, as of the next
    private double[] radii = new double[2];
    private Vector3D[] positions = new Vector3D[2];
    private Vector3D[] velocities = new Vector3D[2];
    private Vector3D[] accelerations = new Vector3D[2];
    private Vector3D[] spins = new Vector3D[2];

    /// <summary>How many bodies there are.</summary>
    internal int BodyCount => numbered.Count;

    /// <summary>How many contacts there are.</summary>
    internal int ContactCount => contacts.Count;

    /// <summary>The slots of the bodies that these states belong to.</summary>
    internal Span<int> Slots => numbered.Slots;

    /// <summary>In kg; infinite for a held body.</summary>
    internal Span<double> Masses => masses.AsSpan(0, BodyCount);

    /// <summary>In metres.</summary>
    internal Span<double> Radii => radii.AsSpan(0, BodyCount);

    /// <summary>Where the centres are, in metres.</summary>
    internal Span<Vector3D> Positions => positions.AsSpan(0, BodyCount);

    /// <summary>In m/s; before the event is solved as the bodies come to it, then as they leave.</summary>
    internal Span<Vector3D> Velocities => velocities.AsSpan(0, BodyCount);

    /// <summary>The acceleration by forces, in m/s².</summary>
    internal Span<Vector3D> Accelerations => accelerations.AsSpan(0, BodyCount);

    /// <summary>How the bodies turn, in rad/s; as velocities.</summary>
    internal Span<Vector3D> Spins => spins.AsSpan(0, BodyCount);

    internal Span<ContactPoint> Contacts => contacts.All;

    /// <summary>Begins another event.</summary>
    internal void Clear()
    {
        numbered.Clear();
        contacts.Clear();
    }

    /// <summary>Adds a body that is not in the graph, and returns its number. Its state is not known yet.</summary>
    internal int AddBody(int slot)
    {
        if (BodyCount == masses.Length)
        {
            int size = BodyCount * 2;
            Array.Resize(ref masses, size);
            Array.Resize(ref radii, size);
            Array.Resize(ref positions, size);
            Array.Resize(ref velocities, size);
            Array.Resize(ref accelerations, size);
            Array.Resize(ref spins, size);
        }

        return numbered.Add(slot);
    }

    internal void AddContact(in ContactPoint contact) => contacts.Add(contact);

    /// <summary>Leaves out all bodies from a number on.</summary>
    internal void KeepBodies(int count) => numbered.Keep(count);

    /// <summary>Leaves out all contacts from a number on.</summary>
    internal void KeepContacts(int count) => contacts.Keep(count);

    /// <summary>Moves a contact to the place of one before it that is left out.</summary>
    internal void Move(int from, int to) => contacts.Move(from, to);

    /// <summary>The number of a body, or -1 if it is not there.</summary>
    internal int IndexOf(int slot) => numbered.IndexOf(slot);

    /// <summary>Whether a body touches a static surface in it.</summary>
    internal bool HasContact(int body, int surface) => contacts.Has(body, ContactPoint.Static, surface);

    /// <summary>Whether two bodies touch in it.</summary>
    internal bool HasPair(int body, int other) => contacts.Has(Math.Min(body, other), Math.Max(body, other), -1);

    /// <summary>Lists the contacts of each body.</summary>
    internal void List() => contacts.List(BodyCount);

    /// <summary>The contacts of a body, by number, as they were listed last.</summary>
    internal Span<int> ListOf(int body) => contacts.ListOf(body);

    /// <summary>Whether some body is held.</summary>
    internal bool HasHand()
    {
        bool has = false;
        for (int i = 0; i < BodyCount && !has; i++)
        {
            has = paths.IsHeld(timelines.Last(Slots[i]));
        }

        return has;
    }

    /// <summary>
    /// Sorts bodies by identity, and contacts by their bodies' identities and then by surface. So the order of slots, and of discovery,
    /// leaves no trace in any sum over them.
    /// </summary>
    internal void Sort()
    {
        // While bodies move, contacts name them by slot.
        Span<int> slots = Slots;
        foreach (ref ContactPoint c in Contacts)
        {
            c.First = slots[c.First];
            c.Second = c.Second == ContactPoint.Static ? c.Second : slots[c.Second];
        }

        numbered.Sort();
        foreach (ref ContactPoint c in Contacts)
        {
            c.First = IndexOf(c.First);
            c.Second = c.Second == ContactPoint.Static ? c.Second : IndexOf(c.Second);
        }

        contacts.Sort();
    }

    /// <summary>Has the states of all bodies at an instant, by the newest segments of their paths.</summary>
    internal void Evaluate(SimTime time, double residual)
    {
        for (int i = 0; i < BodyCount; i++)
        {
            Evaluate(i, time, residual);
        }
    }

    /// <summary>The same of one body, so many seconds after the tick.</summary>
    internal void Evaluate(int body, SimTime time, double residual)
    {
        int last = timelines.Last(Slots[body]);
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        DenseOutput dense = timelines.Dense(last);
        double seconds = paths.SecondsInto(last, time) + residual;
        masses[body] = segment.Law == MotionLaw.Held ? double.PositiveInfinity : bodies.Spec(Slots[body]).Mass;
        radii[body] = bodies.Spec(Slots[body]).Radius;
        positions[body] = segment.PositionAt(seconds, dense);
        velocities[body] = segment.VelocityAt(seconds, dense);
        accelerations[body] = segment.AccelerationAt(seconds, dense);
        spins[body] = timelines.SpinOf(last).At(seconds);
    }

    /// <summary>Whether one of a contact's two bodies is held. A hand follows its own path, so no contact with it persists.</summary>
    internal bool IsByHand(in ContactPoint c) =>
        double.IsPositiveInfinity(masses[c.First]) || (c.Second != ContactPoint.Static && double.IsPositiveInfinity(masses[c.Second]));

    /// <summary>Whether one of a contact's two bodies is a member of an island.</summary>
    internal bool HasMember(in ContactPoint c) =>
        paths.IsMember(timelines.Last(Slots[c.First])) || (c.Second != ContactPoint.Static && paths.IsMember(timelines.Last(Slots[c.Second])));

    /// <summary>
    /// Whether a body may come to rest or slide on what it hit: a plane, under an acceleration that is the same everywhere.
    /// </summary>
    internal bool IsSupportable(in ContactPoint c) =>
        c.Second == ContactPoint.Static && surfaces.IsPlane(c.Surface) && bodies.Spec(Slots[c.First]).Forces.IsEmpty;

    /// <summary>From the second of a contact to the first, a unit vector.</summary>
    internal Vector3D NormalOf(in ContactPoint c) => c.Second == ContactPoint.Static
        ? surfaces.Normal(c.Surface, positions[c.First])
        : box.Nearest(positions[c.First] - positions[c.Second]).Direction;

    /// <summary>How far apart the centres of two that touch are, in metres; infinite where one is a plane.</summary>
    internal double ReachOf(in ContactPoint c) =>
        c.Second == ContactPoint.Static ? surfaces.Reach(c.Surface, radii[c.First]) : radii[c.First] + radii[c.Second];

    /// <summary>The distance in metres between the two of a contact; negative where they overlap.</summary>
    internal double GapOf(in ContactPoint c) => c.Second == ContactPoint.Static
        ? surfaces.Gap(c.Surface, positions[c.First], radii[c.First])
        : box.Nearest(positions[c.First] - positions[c.Second]).Length - ReachOf(c);

    /// <summary>The lesser of the two restitutions: a material behaves as named against anything more elastic.</summary>
    internal double RestitutionOf(in ContactPoint c) => Math.Min(
        bodies.Spec(Slots[c.First]).Restitution,
        c.Second == ContactPoint.Static ? surfaces.Restitution(c.Surface) : bodies.Spec(Slots[c.Second]).Restitution);

    /// <summary>The lesser of the two coefficients of friction.</summary>
    internal double FrictionOf(in ContactPoint c) => Math.Min(
        bodies.Spec(Slots[c.First]).Friction,
        c.Second == ContactPoint.Static ? surfaces.Friction(c.Surface) : bodies.Spec(Slots[c.Second]).Friction);

    /// <summary>
    /// The lever of rolling resistance of a contact, in metres: the larger of its two bodies', each of which has no more resistance than
    /// friction.
    /// </summary>
    internal double RollingLeverOf(in ContactPoint c)
    {
        double friction = FrictionOf(c);
        double first = Math.Min(bodies.Spec(Slots[c.First]).RollingResistance, friction) * radii[c.First];
        double second = c.Second == ContactPoint.Static ? 0 : Math.Min(bodies.Spec(Slots[c.Second]).RollingResistance, friction) * radii[c.Second];
        return Math.Max(first, second);
    }

    /// <summary>
    /// The impact's key, the same whichever of its contacts was popped: it names the least body that is struck and that body's least
    /// partner. Bodies that only a collapse adds do not count: the key would come before impacts of the round that are done already.
    /// </summary>
    internal EventKey CanonicalKey(in EventKey popped)
    {
        int at = 0;
        while (!IsOfThisRound(Contacts[at]))
        {
            at++;
        }

        int least = Contacts[at].First;
        BodyId first = bodies.Id(Slots[least]);
        BodyId second = first;
        for (int i = at; i < ContactCount && Contacts[i].First == least && second == first; i++)
        {
            second = Contacts[i].Second == ContactPoint.Static || !IsOfThisRound(Contacts[i]) ? first : bodies.Id(Slots[Contacts[i].Second]);
        }

        return new EventKey(popped.Time, popped.Round, EventKind.Impact, first, second, 0, 0);
    }

    private static bool IsOfThisRound(in ContactPoint c) => c.IsStruck && !c.IsFromBefore;
}
