using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Impacts: who takes part, and what comes of it.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// So many rounds of impacts in one instant are endless: elastic ones, for all others collapse. The longest that end, 3,141,592 impacts of two balls and a wall, have a few in each.
    /// </summary>
    private const uint MostRounds = 1 << 16;

    private readonly ImpactSolver solver = new();
    private readonly ImpactFriction friction = new();
    private int[] parties = new int[4];
    private double[] partyMasses = new double[4];
    private Vector3D[] partyPositions = new Vector3D[4];
    private Vector3D[] partyVelocities = new Vector3D[4];
    private bool[] isReached = new bool[4]; // whether an impact's impulse has gone on from a party to those that it holds
    private Vector3D[] partySpins = new Vector3D[4];
    private double[] partyRadii = new double[4];
    private double[] coefficients = new double[8];
    private Vector3D[] partyAccelerations = new Vector3D[4];
    private ContactPoint[] contacts = new ContactPoint[1]; // as many as nearly all impacts have
    private int[] touched = new int[8];
    private int partyCount;
    private int contactCount;

    /// <summary>Takes the operands of a contact the wrong way round: only a test's negative control sets it.</summary>
    internal bool SwapsOperands
    {
        get => faults.SwapsOperands;
        set => faults.SwapsOperands = value;
    }

    private bool TryHandleImpact(int slot, in EventKey key)
    {
        if (IsAlone(slot, key) && TryHandleAlone(slot, key))
        {
            return true;
        }

        if (key.Round >= MostRounds)
        {
            throw Endless(slot, key.Time);
        }

        double residual = Gather(slot, key, out bool collapses);
        if (TryTakeBack(key))
        {
            return false;
        }

        SetTargets(collapses, key.Time);
        lookedAt.Clear();
        bool givesWay = true;
        if (HasHand() && !TrySpread(key, residual, presses: true, out givesWay))
        {
            return false;
        }

        if (!givesWay)
        {
            return true;
        }

        if (ReachesIsland())
        {
            return TrySpread(key, residual, presses: false, out _);
        }

        TellContacts(key);
        int struck = contactCount;
        AddSupports();
        solver.Solve(contacts.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyVelocities.AsSpan(0, partyCount));
        if (!collapses)
        {
            Rub(); // a collapse is only to end
        }
        else if (StillCloses())
        {
            Unite();
        }

        LimitSpeeds();
        contactCount = struck;
        EventKey canonical = CanonicalKey(key);
        for (int i = 0; i < partyCount; i++)
        {
            OpenAfterImpact(i, canonical, residual);
        }

        JoinLookedAt(canonical);
        return true;
    }

    /// <summary>
    /// What an impact would make faster than <see cref="Limits.MaxReboundSpeed"/> leaves it at that speed, in its direction: a rule of the world, the same bits
    /// on every peer. What is not finite stays as it is, and ends the simulation.
    /// </summary>
    private void LimitSpeeds()
    {
        double limit = Limits.MaxReboundSpeed(Scene.SmallestRadius);
        for (int i = 0; i < partyCount; i++)
        {
            double speed = partyVelocities[i].Length;
            if (speed > limit && !double.IsPositiveInfinity(partyMasses[i]))
            {
                partyVelocities[i] *= limit / speed;
            }
        }
    }

    /// <summary>Why an instant does not end.</summary>
    private EndlessInstantException Endless(int slot, SimTime time) => new(
        $"At {time.ToShortString()} the impacts of {Scene.Whose(bodies.Id(slot))} have no end: {MostRounds} in one instant. What is squeezed between others and loses no energy is struck for ever:"
        + " give it, or what squeezes it, a restitution below 1, a mass that is less unlike, or room.", time);

    private void EvaluateParties(SimTime time, double residual)
    {
        for (int i = 0; i < partyCount; i++)
        {
            EvaluateParty(i, time, residual);
        }
    }

    private void EvaluateParty(int party, SimTime time, double residual)
    {
        int last = timelines.Last(parties[party]);
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        DenseOutput dense = timelines.Dense(last);
        double seconds = paths.SecondsInto(last, time) + residual;
        partyMasses[party] = segment.Law == MotionLaw.Held ? double.PositiveInfinity : bodies.Spec(parties[party]).Mass;
        partyPositions[party] = segment.PositionAt(seconds, dense);
        partyVelocities[party] = segment.VelocityAt(seconds, dense);
        partyAccelerations[party] = segment.AccelerationAt(seconds, dense);
        partySpins[party] = timelines.SpinOf(last).At(seconds);
        partyRadii[party] = bodies.Spec(parties[party]).Radius;
    }

    private void SetTargets(bool collapses, SimTime time)
    {
        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.Normal = NormalOf(c);
            double closing = Math.Max(0, -ImpactSolver.Opening(c, partyVelocities));
            double restitution = Restitution(c);
            bool isLast = collapses && WasStruck(c, time);
            double rebound = isLast ? 0 : restitution * closing;
            c.Lasts = IsLast(c, restitution, rebound) || (isLast && HasMember(c));
            c.Target = c.Lasts ? 0 : rebound;
        }
    }

    /// <summary>Whether one of the two is in a hand, which goes its own way, so that nothing lasts on it.</summary>
    private bool IsByHand(in ContactPoint c) =>
        double.IsPositiveInfinity(partyMasses[c.First]) || (c.Second != ContactPoint.Static && double.IsPositiveInfinity(partyMasses[c.Second]));

    private double ReachOf(in ContactPoint c) =>
        c.Second == ContactPoint.Static ? surfaces.Reach(c.Surface, partyRadii[c.First]) : partyRadii[c.First] + partyRadii[c.Second];

    private Vector3D NormalOf(in ContactPoint c) => c.Second == ContactPoint.Static
        ? surfaces.Normal(c.Surface, partyPositions[c.First])
        : Scene.Box.Nearest(partyPositions[c.First] - partyPositions[c.Second]).Direction;

    /// <summary>The lesser of the two parties' restitutions: a material behaves as named against anything more elastic.</summary>
    private double Restitution(in ContactPoint c)
    {
        double first = bodies.Spec(parties[c.First]).Restitution;
        double second = c.Second != ContactPoint.Static ? bodies.Spec(parties[c.Second]).Restitution
            : surfaces.Restitution(c.Surface);
        return Math.Min(first, second);
    }

    /// <summary>Friction in the impact at hand, if any of its parties has some.</summary>
    private void Rub()
    {
        bool rubs = false;
        for (int i = 0; i < partyCount; i++)
        {
            rubs |= bodies.Spec(parties[i]).Friction > 0;
        }

        if (!rubs)
        {
            return;
        }

        if (contactCount > coefficients.Length)
        {
            coefficients = new double[contactCount * 2];
        }

        for (int i = 0; i < contactCount; i++)
        {
            coefficients[i] = Friction(contacts[i]);
        }

        friction.Solve(
            contacts.AsSpan(0, contactCount), coefficients.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyRadii.AsSpan(0, partyCount),
            partyVelocities.AsSpan(0, partyCount), partySpins.AsSpan(0, partyCount));
    }

    /// <summary>The lesser of the two parties' coefficients of friction.</summary>
    private double Friction(in ContactPoint c)
    {
        double first = bodies.Spec(parties[c.First]).Friction;
        double second = c.Second != ContactPoint.Static ? bodies.Spec(parties[c.Second]).Friction
            : surfaces.Friction(c.Surface);
        return Math.Min(first, second);
    }

    /// <summary>Whether a body may come to rest or slide on what it hit: a plane, under an acceleration that is the same everywhere.</summary>
    private bool IsSupportable(in ContactPoint c) =>
        c.Second == ContactPoint.Static && surfaces.IsPlane(c.Surface) && bodies.Spec(parties[c.First]).Forces.IsEmpty;

    /// <summary>A body that is carried stays carried while it is hit: its supports push back as far as they must, and give nothing.</summary>
    private void AddSupports()
    {
        for (int i = 0; i < partyCount; i++)
        {
            SupportSet supports = timelines.Segment(timelines.Last(parties[i])).Supports;
            for (int k = 0; k < supports.Count; k++)
            {
                if (!HasContact(i, supports[k]))
                {
                    AddContact(new ContactPoint(i, ContactPoint.Static, supports[k], default)
                    {
                        Normal = surfaces.Plane(supports[k]).Normal,
                    });
                }
            }
        }
    }

    private bool HasContact(int party, int surface)
    {
        for (int i = 0; i < contactCount; i++)
        {
            if (contacts[i].First == party && contacts[i].Second == ContactPoint.Static && contacts[i].Surface == surface)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>What a collapse takes in besides has no part in its key: that would come before impacts of the round that are done already.</summary>
    private static bool IsOfThisRound(in ContactPoint c) => c.IsStruck && !c.IsFromBefore;

    /// <summary>The impact's key whichever of its contacts was popped: named by the least party that is struck and that one's least partner.</summary>
    private EventKey CanonicalKey(in EventKey popped)
    {
        int at = 0;
        while (!IsOfThisRound(contacts[at]))
        {
            at++;
        }

        int least = contacts[at].First;
        BodyId first = bodies.Id(parties[least]);
        BodyId second = first;
        for (int i = at; i < contactCount && contacts[i].First == least && second == first; i++)
        {
            second = contacts[i].Second == ContactPoint.Static || !IsOfThisRound(contacts[i]) ? first : bodies.Id(parties[contacts[i].Second]);
        }

        return new EventKey(popped.Time, popped.Round, EventKind.Impact, first, second, 0, 0);
    }

    private void OpenAfterImpact(int party, in EventKey key, double residual)
    {
        int slot = parties[party];
        if (paths.IsHeld(timelines.Last(slot)))
        {
            trajectories.Hands.GoOn(slot, key);
            return;
        }

        SupportSet supports = timelines.Segment(timelines.Last(slot)).Supports;
        int count = 0;
        for (int i = 0; i < contactCount; i++)
        {
            ref readonly ContactPoint c = ref contacts[i];
            if (c.First == party && c.IsStruck && IsSupportable(c))
            {
                AddTouched(ref count, c.Surface);
            }
        }

        for (int k = 0; k < supports.Count; k++)
        {
            AddTouched(ref count, supports[k]);
        }

        trajectories.Open(slot, key, partyPositions[party], partyVelocities[party], -residual, touched.AsSpan(0, count), partySpins[party]);
    }

    private void AddTouched(ref int count, int plane)
    {
        int at = count;
        for (int i = 0; i < count; i++)
        {
            if (touched[i] == plane)
            {
                return;
            }
        }

        if (count == touched.Length)
        {
            Array.Resize(ref touched, count * 2);
        }

        for (; at > 0 && touched[at - 1] > plane; at--)
        {
            touched[at] = touched[at - 1];
        }

        touched[at] = plane;
        count++;
    }
}
