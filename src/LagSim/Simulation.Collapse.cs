using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>
/// Inelastic collapse: below a threshold of restitution infinitely many impacts come in a finite time. A contact that closes again in the
/// instant in which it was struck has not parted, for the clock cannot tell the two apart; so it bounces no second time (docs/CONTACT.md,
/// rule 14).
/// </content>
public sealed partial class Simulation
{
    /// <summary>
    /// What was struck twice in an instant and closes again, slower than this, in m/s, waits for <see cref="ContactTime.Soon"/>. What parts
    /// slower than this may as well be said to close: rounding decides.
    /// </summary>
    private const double CollapseSpeed = 1e-6;

    /// <summary>
    /// The first round of an instant in which there can be a collapse: a contact is struck, then something else strikes one of the
    /// two, a round later, and only then can they close again. Rounds are numbered from 0.
    /// </summary>
    private const uint CollapseRound = 2;

    private const int StrikesKnown = 64; // a power of two

    private readonly InelasticCollapse collapse = new();
    private KnownStrikes[]? knownStrikes;

    /// <summary>
    /// Whether something there can take energy, or could once: an inelastic body or surface, or a hand. Where nothing can there is no
    /// collapse to look for, which costs more than the impacts do.
    /// </summary>
    private bool hasLosses;

    /// <summary>Bounces as often as it closes: only a test's negative control sets it.</summary>
    internal bool NeverCollapses { get; set; }

    /// <summary>Whether a contact can have been struck in this instant already.</summary>
    private static bool MayBeStruckAgain(in EventKey key) => key.Round >= CollapseRound;

    /// <summary>
    /// Whether the impact at hand strikes a contact that can lose energy, and that was struck in this instant already, and infinitely many
    /// impacts may follow. Where a member of an island takes part they always may: what holds it gives way to no push, however light it is
    /// itself.
    /// </summary>
    private bool Collapses(SimTime time)
    {
        bool isStruckAgain = false;
        bool hasMember = false;
        for (int i = 0; i < contactCount; i++)
        {
            isStruckAgain |= !contacts[i].IsFromBefore && MayLose(contacts[i]) && WasStruck(contacts[i], time);
            hasMember |= HasMember(contacts[i]);
        }

        if (!isStruckAgain || hasMember)
        {
            return isStruckAgain;
        }

        EvaluateParties(time, 0);
        Span<double> restitutions = contactCount <= 64 ? stackalloc double[contactCount] : new double[contactCount];
        Span<double> frictions = contactCount <= 64 ? stackalloc double[contactCount] : new double[contactCount];
        for (int i = 0; i < contactCount; i++)
        {
            contacts[i].Normal = NormalOf(contacts[i]);
            restitutions[i] = Restitution(contacts[i]);
            frictions[i] = Friction(contacts[i]);
        }

        return collapse.IsPossible(contacts.AsSpan(0, contactCount), restitutions, frictions, partyMasses.AsSpan(0, partyCount));
    }

    private bool WasStruck(in ContactPoint c, SimTime time)
    {
        int first = timelines.Last(parties[c.First]);
        int strikes = c.Second == ContactPoint.Static
            ? StrikesOn(first, c.Surface, time) : StrikesBetween(first, timelines.Last(parties[c.Second]), time);
        return strikes > 0;
    }

    /// <summary>Whether a contact may lose energy: it does not bounce back in full, or there is a hand, which gives and takes.</summary>
    private bool MayLose(in ContactPoint c) => Restitution(c) < 1 || paths.IsHeld(timelines.Last(parties[c.First]))
        || (c.Second != ContactPoint.Static && paths.IsHeld(timelines.Last(parties[c.Second])));

    /// <summary>Whether a contact closes after all that the solver could do.</summary>
    private bool StillCloses()
    {
        bool closes = false;
        for (int i = 0; i < contactCount && !closes; i++)
        {
            closes = ImpactSolver.Opening(contacts[i], partyVelocities) < -CollapseSpeed;
        }

        return closes;
    }

    /// <summary>
    /// What is squeezed so that even plastic impacts do not end it (a mass ratio beyond what the solver resolves) goes on together: with the
    /// velocity of its centre of mass, with that of the first hand that takes part, or at rest where something static does. Nothing closes then, but for what
    /// a hand presses, which is left alone; so the tick ends.
    /// </summary>
    private void Unite()
    {
        double mass = 0;
        Vector3D common = Vector3D.Zero;
        for (int i = 0; i < partyCount && !double.IsPositiveInfinity(mass); i++)
        {
            mass += partyMasses[i];
            common = double.IsPositiveInfinity(mass) ? partyVelocities[i] : common + ((partyVelocities[i] - common) * (partyMasses[i] / mass));
        }

        for (int i = 0; i < contactCount; i++)
        {
            common = contacts[i].Second == ContactPoint.Static ? Vector3D.Zero : common;
        }

        for (int i = 0; i < partyCount; i++)
        {
            partyVelocities[i] = double.IsPositiveInfinity(partyMasses[i]) ? partyVelocities[i] : common;
        }
    }

    private bool HasMember(in ContactPoint c) =>
        paths.IsMember(timelines.Last(parties[c.First])) || (c.Second != ContactPoint.Static && paths.IsMember(timelines.Last(parties[c.Second])));

    /// <summary>Whether a body touches a surface that it struck in this instant.</summary>
    private bool IsStillTouching(int slot, int surface, SimTime time, out ContactTime contact)
    {
        contact = ContactTime.At(time);
        int last = timelines.Last(slot);
        return !paths.IsHeld(last) && surfaces.Gap(surface, paths.PositionAt(last, time), bodies.Spec(slot).Radius) <= Scene.Resolution
            && (Has(HealingFault.CollapsesWithWhoTouches) || StrikesOn(last, surface, time) > 0);
    }

    /// <summary>Whether two bodies touch that struck each other in this instant.</summary>
    private bool AreStillTouching(int slot, int other, int piece, SimTime time, out ContactTime contact)
    {
        contact = ContactTime.At(time);
        int last = timelines.Last(slot);
        return timelines.Segment(piece).IsPresent && !(paths.IsHeld(last) && paths.IsHeld(piece))
            && Gap(slot, last, other, piece, time) <= Scene.Resolution
            && (Has(HealingFault.CollapsesWithWhoTouches) || StrikesBetween(last, piece, time) > 0);
    }

    /// <summary>
    /// How many impacts of this instant were on a body while it did not part from a surface that it touches; two where it is more.
    /// </summary>
    private int StrikesOn(int piece, int surface, SimTime time)
    {
        if (timelines.Key(piece).Time != time)
        {
            return 0;
        }

        ref KnownStrikes known = ref Known(timelines.Owner(piece), ~surface);
        ContactTime tick = ContactTime.At(time);
        int at = piece;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(at).Time == time && timelines.Previous(at) != TimelineStore.None)
        {
            if (known.First == timelines.Serial(at) && known.Second == ~surface)
            {
                strikes += known.Strikes;
                break;
            }

            bool isImpact = timelines.Key(at).Kind == EventKind.Impact;
            at = timelines.Previous(at);
            Vector3D normal = surfaces.Normal(surface, paths.PositionAt(at, tick));
            strikes += isImpact && Vector3D.Dot(normal, paths.VelocityAt(at, tick)) <= CollapseSpeed ? 1 : 0;
        }

        strikes = Math.Min(strikes, 2);
        known = new KnownStrikes(timelines.Serial(piece), ~surface, strikes);
        return strikes;
    }

    /// <summary>
    /// How many impacts of this instant were on two bodies that touch, while they did not part from each other; two where it is more.
    /// </summary>
    private int StrikesBetween(int first, int second, SimTime time)
    {
        if (timelines.Key(first).Time != time || timelines.Key(second).Time != time)
        {
            return 0;
        }

        if (bodies.Id(timelines.Owner(first)) > bodies.Id(timelines.Owner(second)))
        {
            (first, second) = (second, first);
        }

        ref KnownStrikes known = ref Known(timelines.Owner(first), timelines.Owner(second));
        ContactTime tick = ContactTime.At(time);
        int a = first;
        int b = second;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(a).Time == time && timelines.Key(b).Time == time
            && timelines.Previous(a) != TimelineStore.None && timelines.Previous(b) != TimelineStore.None)
        {
            if (known.First == timelines.Serial(a) && known.Second == timelines.Serial(b))
            {
                strikes += known.Strikes;
                break;
            }

            int order = EventKey.Compare(timelines.Key(a), timelines.Key(b));
            bool isImpact = order == 0 && timelines.Key(a).Kind == EventKind.Impact;
            a = order >= 0 ? timelines.Previous(a) : a;
            b = order <= 0 ? timelines.Previous(b) : b;
            Vector3D normal = Scene.Box.Nearest(paths.PositionAt(a, tick) - paths.PositionAt(b, tick)).Direction;
            strikes += isImpact && Vector3D.Dot(normal, paths.VelocityAt(a, tick) - paths.VelocityAt(b, tick)) <= CollapseSpeed ? 1 : 0;
        }

        strikes = Math.Min(strikes, 2);
        known = new KnownStrikes(timelines.Serial(first), timelines.Serial(second), strikes);
        return strikes;
    }

    /// <summary>The place of what was last found out about two.</summary>
    private ref KnownStrikes Known(int first, int second)
    {
        knownStrikes ??= new KnownStrikes[StrikesKnown];
        return ref knownStrikes[((first * 31) + second) & (StrikesKnown - 1)];
    }

    /// <summary>
    /// What was found out about two pieces of paths: a walk back through an instant ends there. It only saves time, for the same two pieces
    /// always give the same; without it an instant of many rounds takes their square.
    /// </summary>
    private readonly struct KnownStrikes(long first, long second, int strikes)
    {
        /// <summary>The serial number of the first piece; those of pieces begin at 0, so that 0 and 0 is nobody.</summary>
        internal readonly long First = first;

        /// <summary>That of the second, or the complement of the surface.</summary>
        internal readonly long Second = second;

        internal readonly int Strikes = strikes;
    }
}
