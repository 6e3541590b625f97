using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>
/// Inelastic collapse: below a threshold of restitution infinitely many impacts come in a finite time. A contact that closes again in the
/// instant in which it was struck has not parted, because the clock cannot distinguish the two. So it does not bounce a second time
/// (docs/CONTACT.md, rule 14).
/// </summary>
internal class CollapseRule(
    Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, StrikeCounts strikes)
{
    /// <summary>
    /// The round from which on an instant is closed. A row of n touching balls of one mass passes every impact on within n rounds, so rows
    /// of 1024 are followed to the end, and a ball that is squeezed against a wall by one of 100,000 times its mass (pi times the root of
    /// the ratio). A closed instant loses no energy that the bodies could have kept, so where exactly it begins matters little.
    /// </summary>
    private const uint LongRound = 1024;

    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly Paths paths = new(timelines);
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly InelasticCollapse collapse = new();

    /// <summary>
    /// Whether something can take energy, or could once: an inelastic body or surface, or a hand. If nothing can, there is no search for a
    /// collapse, which costs more than the impacts do.
    /// </summary>
    internal bool HasLosses { get; set; } = scene.Surfaces.TakesEnergy();

    /// <summary>Whether a contact can have been struck in this instant already.</summary>
    internal static bool MayBeStruckAgain(in EventKey key) => key.Round >= CollisionPredictor.CollapseRound;

    /// <summary>
    /// Whether an instant has gone on for so long that it is closed: what is struck again in it is solved together, whether it loses energy
    /// or not.
    /// </summary>
    internal static bool IsLong(in EventKey key) => key.Round >= LongRound;

    /// <summary>
    /// Whether what is solved together gives back what it was pressed with. Sweeps over an island leave some of that; where the instant goes
    /// on for it as long again, nothing is given back, and what members do not bounce off holds.
    /// </summary>
    internal static bool GivesBack(in EventKey key) => IsLong(key) && !IsOverlong(key);

    /// <summary>
    /// Whether it goes on in spite of that, so that what an island's sweeps leave closing is joined (<see cref="PlasticImpact"/>). A light
    /// body between heavy ones passes on in a sweep only as much as it weighs, and would be struck as often as its mass is contained in theirs.
    /// </summary>
    internal static bool IsOverlong(in EventKey key) => key.Round >= 2 * LongRound;

    /// <summary>
    /// Whether the current impact strikes a contact that can lose energy and that was struck in this instant already, and infinitely many
    /// impacts may follow. Where a member of an island takes part they always may: the bodies that hold it give way to no push, however
    /// light they are themselves.
    /// </summary>
    /// <param name="key">The impact.</param>
    /// <param name="askedAll">Whether that depends on all of the graph, and not only on what is struck now.</param>
    internal virtual bool Collapses(in EventKey key, out bool askedAll)
    {
        SimTime time = key.Time;
        bool isLong = IsLong(key);
        bool isStruckAgain = false;
        bool hasMember = false;
        for (int i = 0; i < graph.ContactCount; i++)
        {
            isStruckAgain |= !graph.Contacts[i].IsFromBefore && (isLong || MayLose(graph.Contacts[i])) && WasStruck(graph.Contacts[i], time);
            hasMember |= graph.HasMember(graph.Contacts[i]);
        }

        askedAll = isStruckAgain;
        if (!isStruckAgain || hasMember || isLong)
        {
            return isStruckAgain;
        }

        graph.Evaluate(time, 0);
        Span<double> restitutions = graph.ContactCount <= 64 ? stackalloc double[graph.ContactCount] : new double[graph.ContactCount];
        Span<double> frictions = graph.ContactCount <= 64 ? stackalloc double[graph.ContactCount] : new double[graph.ContactCount];
        for (int i = 0; i < graph.ContactCount; i++)
        {
            graph.Contacts[i].Normal = graph.NormalOf(graph.Contacts[i]);
            restitutions[i] = graph.RestitutionOf(graph.Contacts[i]);
            frictions[i] = graph.FrictionOf(graph.Contacts[i]);
        }

        return collapse.IsPossible(graph.Contacts, restitutions, frictions, graph.Masses);
    }

    /// <summary>Whether the two of a contact were struck in this instant already, and have not parted.</summary>
    internal bool WasStruck(in ContactPoint c, SimTime time)
    {
        int first = timelines.Last(graph.Slots[c.First]);
        return (c.Second == ContactPoint.Static
            ? strikes.On(first, c.Surface, time) : strikes.Between(first, timelines.Last(graph.Slots[c.Second]), time)) > 0;
    }

    /// <summary>Whether a contact may lose energy: it does not bounce back in full, or there is a hand, which gives and takes.</summary>
    private bool MayLose(in ContactPoint c) => graph.RestitutionOf(c) < 1 || paths.IsHeld(timelines.Last(graph.Slots[c.First]))
        || (c.Second != ContactPoint.Static && paths.IsHeld(timelines.Last(graph.Slots[c.Second])));

    /// <summary>Whether a contact closes after all that the solver could do.</summary>
    internal bool StillCloses()
    {
        bool closes = false;
        for (int i = 0; i < graph.ContactCount && !closes; i++)
        {
            closes = ImpactSolver.Opening(graph.Contacts[i], graph.Velocities) < -StrikeCounts.CollapseSpeed;
        }

        return closes;
    }

    /// <summary>
    /// Bodies that are squeezed so that even plastic impacts do not end it (a mass ratio beyond what the solver resolves) continue
    /// together: with the velocity of their centre of mass, with that of the first hand that takes part, or at rest where something static
    /// does. Nothing closes then, except what a hand presses, which is left alone. So the tick ends.
    /// </summary>
    internal void GoOnTogether()
    {
        double mass = 0;
        Vector3D common = Vector3D.Zero;
        for (int i = 0; i < graph.BodyCount && !double.IsPositiveInfinity(mass); i++)
        {
            mass += graph.Masses[i];
            common = double.IsPositiveInfinity(mass) ? graph.Velocities[i] : common + ((graph.Velocities[i] - common) * (graph.Masses[i] / mass));
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            common = graph.Contacts[i].Second == ContactPoint.Static ? Vector3D.Zero : common;
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            graph.Velocities[i] = double.IsPositiveInfinity(graph.Masses[i]) ? graph.Velocities[i] : common;
        }
    }

    /// <summary>Whether a body touches a surface that it struck in this instant.</summary>
    internal bool IsStillTouching(int slot, int surface, SimTime time, out ContactTime contact)
    {
        contact = ContactTime.At(time);
        int last = timelines.Last(slot);
        return !paths.IsHeld(last) && filters.MeetSurface(last, surface)
            && surfaces.Gap(surface, paths.PositionAt(last, time), bodies.Spec(slot).Radius) <= scene.RestitutionThreshold
            && TakesIn(strikes.On(last, surface, time));
    }

    /// <summary>Whether two bodies touch that struck each other in this instant.</summary>
    internal bool AreStillTouching(int slot, int other, int piece, SimTime time, out ContactTime contact)
    {
        contact = ContactTime.At(time);
        int last = timelines.Last(slot);
        return timelines.Segment(piece).IsPresent && filters.Meet(last, piece) && !(paths.IsHeld(last) && paths.IsHeld(piece))
            && Gap(slot, last, other, piece, time) <= scene.RestitutionThreshold
            && TakesIn(strikes.Between(last, piece, time));
    }

    /// <summary>Whether what touches is part of a collapse, by how often it was struck in this instant.</summary>
    private protected virtual bool TakesIn(int strikeCount) => strikeCount > 0;

    /// <summary>
    /// The distance between two bodies' surfaces at a tick, on these segments; the same bits in whichever order the bodies
    /// come.
    /// </summary>
    private double Gap(int slot, int piece, int other, int otherPiece, SimTime time) =>
        scene.Box.Nearest(paths.PositionAt(piece, time) - paths.PositionAt(otherPiece, time)).Length - (bodies.Spec(slot).Radius + bodies.Spec(other).Radius);
}
