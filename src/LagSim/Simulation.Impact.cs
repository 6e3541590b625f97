using System;
using System.Collections.Generic;
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
    /// How high, in units of the scene's resolution, a rebound must rise not to be the last of a contact that is pressed together and that no plane alone
    /// carries: 1 micrometre by default. Lasting contact with a hand goes on by hops of that height, some thousand a second.
    /// </summary>
    private const double HopHeight = 1000;

    /// <summary>
    /// The slowest rebound in m/s of a contact that nothing presses together. Bodies that touch and move as one close again and again by rounding
    /// alone, at some 1e-16 m/s; this parts them, by less than a tenth of a millimetre a day.
    /// </summary>
    private const double LeastRebound = 1e-9;

    private readonly ImpactSolver solver = new();
    private readonly ImpactFriction friction = new();
    private int[] parties = new int[4];
    private double[] partyMasses = new double[4];
    private Vector3D[] partyPositions = new Vector3D[4];
    private Vector3D[] partyVelocities = new Vector3D[4];
    private Vector3D[] partyTrial = new Vector3D[4];
    private Vector3D[] partySpins = new Vector3D[4];
    private double[] partyRadii = new double[4];
    private double[] coefficients = new double[8];
    private Vector3D[] partyAccelerations = new Vector3D[4];
    private ContactPoint[] contacts = new ContactPoint[1]; // as many as nearly all impacts have
    private int[] touched = new int[8];
    private readonly List<int> lookedAt = new(); // of the impact at hand, if it looks at what is near
    private int partyCount;
    private int contactCount;

    /// <summary>Takes the operands of a contact the wrong way round: only a test's negative control sets it.</summary>
    internal bool SwapsOperands { get; set; }

    private bool TryHandleImpact(int slot, in EventKey key)
    {
        if (IsAlone(slot, key) && TryHandleAlone(slot, key))
        {
            return true;
        }

        double residual = Gather(slot, key, IgnoresCrowding ? int.MaxValue : CrowdedAfter, NearGap);
        if (TryTakeBack(key))
        {
            return false;
        }

        lookedAt.Clear();
        for (int i = 0; i < partyCount && hasNear; i++)
        {
            lookedAt.Add(parties[i]);
        }

        if (IsTooCrowded || (hasNear && !IsLasting()))
        {
            residual = Gather(slot, key, SqueezedAfter, Scene.Resolution);
            if (TryTakeBack(key))
            {
                return false;
            }
        }

        SetTargets(key.Round);
        TellContacts(key);
        int struck = contactCount;
        AddSupports();
        solver.Solve(contacts.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyVelocities.AsSpan(0, partyCount));
        if (key.Round >= 2 * CollapseRound)
        {
            Unite();
        }

        if (key.Round < CollapseRound)
        {
            Rub(); // from there on a tick is only to end
        }

        LimitSpeeds();
        contactCount = struck;

        EventKey canonical = CanonicalKey(key);
        bool mayLast = MayLast();
        if (mayLast)
        {
            OpenIslands(canonical, -residual, mayRest: false);
        }

        for (int i = 0; i < partyCount; i++)
        {
            if (!mayLast || !isOpened[i])
            {
                OpenAfterImpact(i, canonical, residual);
            }
        }

        if (mayLast)
        {
            JoinIslands(parties, partyCount);
        }

        timelines.Join(parties.AsSpan(0, partyCount));
        int opened = timelines.Last(parties[0]);
        foreach (int seen in lookedAt)
        {
            witnesses.Add(seen, canonical, opened, timelines.Serial(opened), HistoryEdge);
        }

        for (int i = 0; i < partyCount; i++)
        {
            Predict(parties[i]);
        }

        return true;
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

    private void EvaluateParties(SimTime time, double residual)
    {
        for (int i = 0; i < partyCount; i++)
        {
            int last = timelines.Last(parties[i]);
            ref readonly MotionSegment segment = ref timelines.Segment(last);
            DenseOutput dense = timelines.Dense(last);
            double seconds = SecondsInto(last, time) + residual;
            partyMasses[i] = segment.Law == MotionLaw.Held ? double.PositiveInfinity : bodies[parties[i]].Spec.Mass;
            partyPositions[i] = segment.PositionAt(seconds, dense);
            partyVelocities[i] = segment.VelocityAt(seconds, dense);
            partyAccelerations[i] = segment.AccelerationAt(seconds, dense);
            partySpins[i] = timelines.SpinOf(last).At(seconds);
            partyRadii[i] = bodies[parties[i]].Spec.Radius;
        }
    }

    private void SetTargets(uint round)
    {
        bool mayLast = false;
        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.Normal = NormalOf(c);
            double opening = ImpactSolver.Opening(c, partyVelocities);
            c.Restored = round >= CollapseRound || hasNear ? 0 : Restitution(c) * Math.Max(0, -opening);
            mayLast |= c.IsStruck && c.Restored < HopSpeed(Pressing(c));
        }

        if (mayLast && round < CollapseRound)
        {
            FindPressing();
        }

        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.Target = round >= CollapseRound ? 0
                : c.IsStruck ? Math.Max(c.Restored, LeastTarget(c))
                // nothing may drive the two together; of itself it asks for no more than it has
                : Math.Min(Math.Max(0, ImpactSolver.Opening(c, partyVelocities)), HopSpeed(Pressing(c)));
            if (mayLast && c.Pushes && c.IsStruck && c.Restored < HopSpeed(Pressing(c)))
            {
                c.Restored = 0; // what is left of bouncing rises less than a hop: the contact lasts from here on
                c.Target = 0;
            }
        }
    }

    /// <summary>Whether a plane that carries a body rubs on it, so that not gravity alone may press it against another.</summary>
    private bool IsRubbed(int slot)
    {
        SupportSet supports = timelines.Segment(timelines.Last(slot)).Supports;
        return supports.Count == 1 && FrictionOn(slot, supports[0]) > 0;
    }

    /// <summary>
    /// Marks the contacts of the impact at hand that are pressed together: by the paths that they are on, as friction may have it; or by gravity and forces now
    /// that they touch, which the accelerations tell that are left if no contact may close, nor what carries the parties already give way.
    /// </summary>
    private void FindPressing()
    {
        if (partyCount == 1 && contactCount == 1 && IsSupportable(contacts[0]) && !IsRubbed(parties[0]))
        {
            return; // its bounces are followed down to the scene's resolution
        }

        for (int i = 0; i < partyCount; i++)
        {
            partyTrial[i] = double.IsPositiveInfinity(partyMasses[i]) ? partyAccelerations[i]
                : forces.On(bodies[parties[i]].Id).At(bodies[parties[i]].Spec, clock.Time, 0, partyPositions[i], partyVelocities[i], partySpins[i]);
        }

        int gathered = contactCount;
        AddSupports();
        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.Target = 0;
            double falls = 0;
            if (c.Second != ContactPoint.Static || c.Surface >= Scene.PlaneArray.Length)
            {
                Vector3D velocity = partyVelocities[c.First] - (c.Second == ContactPoint.Static ? Vector3D.Zero : partyVelocities[c.Second]);
                falls = FallingAway(c.Normal, velocity, ReachOf(c));
                c.Target = -falls;
            }

            c.Pushes = ImpactSolver.Opening(c, partyAccelerations) + falls < 0;
        }

        solver.Solve(contacts.AsSpan(0, contactCount), partyMasses.AsSpan(0, partyCount), partyTrial.AsSpan(0, partyCount));
        contactCount = gathered;
        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.Pushes = (c.Pushes || c.Impulse > 0) && !IsByHand(c) && !Scene.Box.Exists;
            c.Impulse = 0;
        }
    }

    /// <summary>Whether one of the two is in a hand, which goes its own way, so that nothing lasts on it.</summary>
    private bool IsByHand(in ContactPoint c) =>
        double.IsPositiveInfinity(partyMasses[c.First]) || (c.Second != ContactPoint.Static && double.IsPositiveInfinity(partyMasses[c.Second]));

    private double ReachOf(in ContactPoint c) =>
        partyRadii[c.First] + (c.Second == ContactPoint.Static ? Scene.SphereArray[c.Surface - Scene.PlaneArray.Length].Radius : partyRadii[c.Second]);

    private Vector3D NormalOf(in ContactPoint c) => c.Second == ContactPoint.Static
        ? SurfaceNormal(c.Surface, partyPositions[c.First])
        : Direction(Scene.Box.Nearest(partyPositions[c.First] - partyPositions[c.Second]));

    /// <summary>
    /// The least speed in m/s at which the two of a struck contact part: none on a plane that may carry, that of a hop where a hand presses, else what parts
    /// them at all.
    /// </summary>
    private double LeastTarget(in ContactPoint c)
    {
        if (IsSupportable(c) && Vector3D.Dot(c.Normal, Scene.Gravity) < 0)
        {
            return 0;
        }

        if (!IsByHand(c))
        {
            return LeastRebound;
        }

        Vector3D other = c.Second == ContactPoint.Static ? Vector3D.Zero : partyAccelerations[c.Second];
        double pressing = Math.Max(0, -Vector3D.Dot(c.Normal, partyAccelerations[c.First] - other));
        return Math.Max(HopSpeed(pressing), LeastRebound);
    }

    private double Pressing(in ContactPoint c)
    {
        double pressing = Math.Max(Scene.Gravity.Length, partyAccelerations[c.First].Length);
        return c.Second == ContactPoint.Static ? pressing : Math.Max(pressing, partyAccelerations[c.Second].Length);
    }

    /// <summary>The lesser of the two parties' restitutions: a material behaves as named against anything more elastic.</summary>
    private double Restitution(in ContactPoint c)
    {
        double first = bodies[parties[c.First]].Spec.Restitution;
        double second = c.Second != ContactPoint.Static ? bodies[parties[c.Second]].Spec.Restitution
            : c.Surface < Scene.PlaneArray.Length ? Scene.PlaneArray[c.Surface].Restitution
            : Scene.SphereArray[c.Surface - Scene.PlaneArray.Length].Restitution;
        return Math.Min(first, second);
    }

    /// <summary>Friction in the impact at hand, if any of its parties has some.</summary>
    private void Rub()
    {
        bool rubs = false;
        for (int i = 0; i < partyCount; i++)
        {
            rubs |= bodies[parties[i]].Spec.Friction > 0;
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
        SettleDriven();
    }

    /// <summary>The lesser of the two parties' coefficients of friction.</summary>
    private double Friction(in ContactPoint c)
    {
        double first = bodies[parties[c.First]].Spec.Friction;
        double second = c.Second != ContactPoint.Static ? bodies[parties[c.Second]].Spec.Friction
            : c.Surface < Scene.PlaneArray.Length ? Scene.PlaneArray[c.Surface].Friction
            : Scene.SphereArray[c.Surface - Scene.PlaneArray.Length].Friction;
        return Math.Min(first, second);
    }

    /// <summary>Whether a body may come to rest or slide on what it hit: a plane, under an acceleration that is the same everywhere.</summary>
    private bool IsSupportable(in ContactPoint c) =>
        c.Second == ContactPoint.Static && c.Surface < Scene.PlaneArray.Length && bodies[parties[c.First]].Spec.Forces.IsEmpty;

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
                        Normal = Scene.PlaneArray[supports[k]].Normal,
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

    /// <summary>The impact's key whichever of its contacts was popped: named by the least party that is struck and that one's least partner.</summary>
    private EventKey CanonicalKey(in EventKey popped)
    {
        int at = 0;
        while (!contacts[at].IsStruck)
        {
            at++;
        }

        int least = contacts[at].First;
        BodyId first = bodies[parties[least]].Id;
        BodyId second = first;
        for (int i = at; i < contactCount && contacts[i].First == least && second == first; i++)
        {
            second = contacts[i].Second == ContactPoint.Static || !contacts[i].IsStruck ? first : bodies[parties[contacts[i].Second]].Id;
        }

        return new EventKey(popped.Time, popped.Round, EventKind.Impact, first, second, 0, 0);
    }

    private void OpenAfterImpact(int party, in EventKey key, double residual)
    {
        int slot = parties[party];
        if (IsHeld(timelines.Last(slot)))
        {
            GoOnHeld(slot, key);
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

        Open(slot, key, partyPositions[party], partyVelocities[party], -residual, touched.AsSpan(0, count), CrowdingAt(slot, key.Time), partySpins[party]);
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
