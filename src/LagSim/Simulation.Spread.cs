using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Impacts that reach islands, or begin them: an impulse spreads over lasting contacts as far as it changes velocities.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// One sweep to and one fro, while an impact is still found to reach more: how far it goes shows in its first sweeps, and it is solved to the end once it reaches
    /// nobody else.
    /// </summary>
    private const int GrowingSweeps = 2;

    private readonly ContactProblem reached = new();
    private readonly NormalsAfterSweeps normals = new();
    private bool[] isReached = Array.Empty<bool>(); // whether the impulse has gone on from a body to those that it holds
    private Vector3D[] velocitiesBefore = Array.Empty<Vector3D>();
    private Vector3D[] spinsBefore = Array.Empty<Vector3D>();

    private bool ReachesIsland()
    {
        bool reaches = false;
        for (int i = 0; i < graph.BodyCount && !reaches; i++)
        {
            reaches = paths.IsMember(timelines.Last(graph.Slots[i]));
        }

        for (int i = 0; i < graph.ContactCount && !reaches; i++)
        {
            reaches = graph.Contacts[i].Lasts || (graph.IsByHand(graph.Contacts[i]) && capture.IsBacked(graph.Contacts[i]));
        }

        return reaches;
    }

    /// <summary>Solves the impact at hand with the lasting contacts that it reaches; false if somebody was ahead of it and has been taken back.</summary>
    /// <param name="popped">The impact's key.</param>
    /// <param name="residual">Seconds from the tick to the impact.</param>
    /// <param name="presses">
    /// Whether to press what a hand strikes against the static surfaces that are within the contact tolerance on its way: bounces with less room than that are none.
    /// </param>
    /// <param name="givesWay">Whether what the hand strikes can give way, or has room: then nothing was done, and it is an impact like others.</param>
    private bool TrySpread(in EventKey popped, double residual, bool presses, out bool givesWay)
    {
        givesWay = false;
        EventKey key = CanonicalKey(popped);
        reached.Clear();
        int struckParties = graph.BodyCount;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            AddReached(i);
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            ref SolverContact added = ref reached.AddContact(c.First, c.Second, c.Surface, c.Normal, 0, graph.FrictionOf(c), graph.RollingLeverOf(c));
            added.Target = c.Target;
        }

        AddReachedSupports();
        double tolerance = step.Scale.SweepSpeed;
        double more = step.Scale.Pull * step.Scale.Step.ToSeconds();
        LimitAgain(more);
        SolveReached(tolerance, GrowingSweeps, 0, 0);
        partners.Ahead.Clear();
        bool isNear = false;
        bool isSolved = false;
        for (bool goesOn = true; goesOn && partners.Ahead.Count == 0;)
        {
            bool grows = false;
            bool hasHand = graph.HasHand();
            int known = graph.BodyCount;
            int knownContacts = reached.ContactCount;
            for (int i = 0; i < known; i++)
            {
                if (!isReached[i] && (reached.Bodies[i].Velocity - velocitiesBefore[i]).Length > step.Scale.ReachSpeed)
                {
                    isReached[i] = true;
                    grows |= TryReachOn(i, key, residual, presses);
                }
            }

            for (int i = 0; i < known && partners.Ahead.Count == 0 && hasHand; i++)
            {
                if (TryReachNear(i, key.Time, tolerance))
                {
                    isNear = true;
                    grows = true;
                }
            }

            goesOn = grows || !isSolved; // what it was solved to may reach others yet
            if (goesOn && partners.Ahead.Count == 0)
            {
                LimitAgain(more);
                SolveReached(tolerance, grows ? GrowingSweeps : ContactStep.MostSweeps, known, knownContacts);
                isSolved = !grows;
            }
        }

        if (partners.Ahead.Count > 0)
        {
            TakeBackAhead(key);
            return false;
        }

        if (presses && !(isNear && IsSqueezed()))
        {
            givesWay = true;
            for (int i = struckParties; i < graph.BodyCount; i++)
            {
                partners.NearMisses.Add(graph.Slots[i]);
            }

            graph.KeepBodies(struckParties);
            return true;
        }

        TellContacts(key);
        DropReboundsThatGain(tolerance);
        KeepPressed(isNear);
        OpenReached(key, residual);
        JoinNearMisses(key);
        return true;
    }

    /// <summary>Whether what a hand strikes is pressed against a static surface.</summary>
    private bool IsSqueezed()
    {
        bool isSqueezed = false;
        for (int i = graph.ContactCount; i < reached.ContactCount && !isSqueezed; i++)
        {
            ref readonly SolverContact c = ref reached.Contacts[i];
            isSqueezed = c.Impulse > 0 && c.Second == ContactPoint.Static;
        }

        return isSqueezed;
    }

    /// <summary>What a hand presses against something lasts, and what it presses it against too.</summary>
    private void KeepPressed(bool presses)
    {
        for (int i = 0; i < graph.ContactCount; i++)
        {
            graph.Contacts[i].Lasts |= graph.IsByHand(graph.Contacts[i]) && reached.Contacts[i].Impulse >= reached.Contacts[i].Most;
        }

        for (int i = graph.ContactCount; i < reached.ContactCount && presses; i++)
        {
            ref readonly SolverContact c = ref reached.Contacts[i];
            if (c.Impulse > 0)
            {
                graph.AddContact(new ContactPoint(c.First, c.Second, c.Surface, default) { Normal = c.Normal, IsStruck = false, Lasts = true });
            }
        }
    }

    /// <summary>
    /// Adds the static surfaces that a party is pushed towards and would reach within the contact tolerance. Not other bodies: that one is near without being struck no
    /// heal would find.
    /// </summary>
    private bool TryReachNear(int party, SimTime time, double tolerance)
    {
        Vector3D push = reached.Bodies[party].Velocity - velocitiesBefore[party];
        if (double.IsPositiveInfinity(graph.Masses[party]) || push.Length <= tolerance)
        {
            return false;
        }

        double left = step.Scale.TickFrom(time, double.PositiveInfinity).SecondsSince(time);
        bool any = false;
        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            ContactPoint c = new(party, ContactPoint.Static, surface, default);
            if (!IsReached(c) && Vector3D.Dot(graph.NormalOf(c), push) < -tolerance && graph.GapOf(c) <= step.Scale.Length)
            {
                AddReachedContact(c, left);
                any = true;
            }
        }

        return any;
    }

    private bool IsReached(in ContactPoint c)
    {
        bool isReached = false;
        for (int i = 0; i < reached.ContactCount && !isReached; i++)
        {
            ref readonly SolverContact known = ref reached.Contacts[i];
            isReached = known.First == c.First && known.Second == c.Second && known.Surface == c.Surface;
        }

        return isReached;
    }

    /// <summary>Goes on from the impulses so far.</summary>
    private void SolveReached(double tolerance, int sweeps, int knownBodies, int knownContacts)
    {
        int taken = ContactSolver.Solve(reached, tolerance, sweeps, knownBodies, knownContacts);
        if (sweeps == ContactStep.MostSweeps && !SweepsAlone && NormalsAfterSweeps.IsNeeded(reached, taken, tolerance))
        {
            for (int i = 0; i < graph.BodyCount; i++)
            {
                reached.Bodies[i].Velocity = velocitiesBefore[i];
                reached.Bodies[i].Spin = spinsBefore[i];
            }

            taken += normals.Solve(reached, tolerance);
        }

        work.Count(taken, reached.ContactCount);
    }

    /// <summary>The more bodies are reached, the more a hand may give; by the velocities before.</summary>
    private void LimitAgain(double more)
    {
        if (!PressesOn)
        {
            SwapVelocities();
            ContactSolver.LimitHands(reached, more);
            SwapVelocities();
        }
    }

    private void SwapVelocities()
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            ref SolverBody body = ref reached.Bodies[i];
            (body.Velocity, velocitiesBefore[i]) = (velocitiesBefore[i], body.Velocity);
            (body.Spin, spinsBefore[i]) = (spinsBefore[i], body.Spin);
        }
    }

    private void AddReached(int party)
    {
        reached.AddBody(graph.Masses[party], graph.Radii[party], graph.Velocities[party], graph.Spins[party]);
        if (party >= velocitiesBefore.Length)
        {
            int size = Math.Max(4, graph.BodyCount * 2);
            Array.Resize(ref velocitiesBefore, size);
            Array.Resize(ref spinsBefore, size);
            Array.Resize(ref isReached, size);
        }

        velocitiesBefore[party] = graph.Velocities[party];
        spinsBefore[party] = graph.Spins[party];
        isReached[party] = double.IsPositiveInfinity(graph.Masses[party]);
    }

    /// <summary>What carries a party by a closed form holds it up while it is struck.</summary>
    private void AddReachedSupports()
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            SupportSet supports = timelines.Segment(timelines.Last(graph.Slots[i])).Supports;
            for (int k = 0; k < supports.Count; k++)
            {
                if (!graph.HasContact(i, supports[k]))
                {
                    double friction = trajectories.Friction.On(graph.Slots[i], supports[k]);
                    double lever = Math.Min(bodies.Spec(graph.Slots[i]).RollingResistance, friction) * graph.Radii[i];
                    reached.AddContact(i, ContactPoint.Static, supports[k], surfaces.Plane(supports[k]).Normal, 0, friction, lever);
                }
            }
        }
    }

    /// <summary>Adds the lasting contacts of a party whose velocity the impact has changed, and the bodies on their other sides.</summary>
    private bool TryReachOn(int party, in EventKey key, double residual, bool presses)
    {
        int slot = graph.Slots[party];
        int piece = timelines.Last(slot);
        if (!paths.IsMember(piece))
        {
            return false;
        }

        bool any = false;
        SimTime end = timelines.Segment(piece).Law == MotionLaw.Resting ? step.Scale.TickFrom(key.Time, double.PositiveInfinity) : timelines.Segment(piece).End;
        double left = end.SecondsSince(key.Time);
        for (int at = timelines.FirstContact(piece); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            LastingContact contact = timelines.Contact(at);
            if (!contact.Holds || (!presses && memberContacts.IsElastic(slot, contact)))
            {
                continue; // that there is room to close in is not used up yet, or an impact tells when
            }

            if (contact.Surface != LastingContact.NoSurface)
            {
                if (!graph.HasContact(party, contact.Surface))
                {
                    AddReachedContact(new ContactPoint(party, ContactPoint.Static, contact.Surface, default), left);
                    any = true;
                }

                continue;
            }

            if (!partners.TryFind(bodies.Id(slot), contact.Partner, key, out int partner))
            {
                continue;
            }

            int other = graph.IndexOf(partner);
            if (other >= 0 && (isReached[other] && !double.IsPositiveInfinity(graph.Masses[other])))
            {
                continue; // it has added the contact
            }

            if (other >= 0 && graph.HasPair(party, other))
            {
                continue;
            }

            if (other < 0)
            {
                other = graph.AddBody(partner);
                graph.Evaluate(other, key.Time, residual);
                AddReached(other);
            }

            bool ordered = bodies.Id(slot) < bodies.Id(partner);
            AddReachedContact(new ContactPoint(ordered ? party : other, ordered ? other : party, -1, default), left);
            any = true;
        }

        return any;
    }

    private void AddReachedContact(ContactPoint c, double left)
    {
        c.Normal = graph.NormalOf(c);
        double gap = graph.GapOf(c);
        ref SolverContact added = ref reached.AddContact(c.First, c.Second, c.Surface, c.Normal, gap, graph.FrictionOf(c), graph.RollingLeverOf(c));
        added.Target = gap > 0 && left > 0 ? -gap / left : 0;
    }

    /// <summary>Has a hand press with any force: only a test's negative control sets it.</summary>
    internal bool PressesOn
    {
        get => step.HandsHaveNoLimit;
        set => step.HandsHaveNoLimit = value;
    }

    /// <summary>
    /// Lets steps of islands (rule 6 of docs/CONTACT.md) and impacts on them (rule 8) make energy: only a test's negative control sets it.
    /// </summary>
    internal bool GainsEnergy
    {
        get => step.MayGainEnergy;
        set => step.MayGainEnergy = value;
    }

    /// <summary>
    /// Has the normals of steps and of impacts on islands solved by sweeps alone (rule 4): only a test's negative control sets it.
    /// </summary>
    internal bool SweepsAlone
    {
        get => step.SweepsAlone;
        set => step.SweepsAlone = value;
    }

    /// <summary>Rebound and friction together may make energy where several contacts share bodies; then there is no rebound.</summary>
    private void DropReboundsThatGain(double tolerance)
    {
        double after = reached.KineticEnergy();
        SwapVelocities();
        if (GainsEnergy || reached.HasHand() || !ContactProblem.IsGain(reached.KineticEnergy(), after))
        {
            SwapVelocities();
            return;
        }

        for (int i = 0; i < graph.BodyCount; i++)
        {
            velocitiesBefore[i] = reached.Bodies[i].Velocity;
            spinsBefore[i] = reached.Bodies[i].Spin;
        }

        reached.DropRebounds();
        SolveReached(tolerance, ContactStep.MostSweeps, 0, 0);
    }

    private void OpenReached(in EventKey key, double residual)
    {
        SimTime end = SimTime.MaxValue;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(graph.Slots[i]));
            end = path.Law == MotionLaw.Constrained ? SimTime.Min(end, path.End) : end;
            graph.Velocities[i] = reached.Bodies[i].Velocity;
            graph.Spins[i] = reached.Bodies[i].Spin;
        }

        resolver.LimitSpeeds();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int slot = graph.Slots[i];
            int before = timelines.Last(slot);
            bool isMember = paths.IsMember(before);
            bool lasts = HasLasting(i);
            if (paths.IsHeld(before))
            {
                trajectories.Hands.GoOn(slot, key);
            }
            else if (!isMember && !lasts)
            {
                OpenAfterImpact(i, key, residual);
            }
            else
            {
                bool hasChanged = lasts || graph.Velocities[i] != velocitiesBefore[i] || graph.Spins[i] != spinsBefore[i];
                Vector3D position = graph.Positions[i] - (graph.Velocities[i] * residual);
                if (isMember)
                {
                    members.GoOn(slot, key, position, graph.Velocities[i], graph.Spins[i], hasChanged);
                }
                else
                {
                    SupportSet supports = timelines.Segment(before).Supports;
                    SimTime tick = members.NextTick(slot, key.Time, members.StepWanted(slot, key.Time, position, graph.Velocities[i], graph.Spins[i]));
                    members.OpenChord(slot, key, end == SimTime.MaxValue ? tick : SimTime.Min(end, tick > key.Time ? tick : end), position, graph.Velocities[i], graph.Spins[i]);
                    timelines.BeginMember(timelines.Last(slot), key.Time, key.Time);
                    for (int k = 0; k < supports.Count; k++)
                    {
                        timelines.AddContact(timelines.Last(slot), new LastingContact(bodies.Id(slot), supports[k], holds: true));
                    }
                }

                AddLasting(i, timelines.Last(slot));
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }
        }
    }

    private bool HasLasting(int party)
    {
        bool has = false;
        for (int i = 0; i < graph.ContactCount && !has; i++)
        {
            has = graph.Contacts[i].Lasts && (graph.Contacts[i].First == party || graph.Contacts[i].Second == party);
        }

        return has;
    }

    /// <summary>A member's new piece carries the contacts of the impact at hand that last from here on; those that bounced off without a loss hold no more.</summary>
    private void AddLasting(int party, int piece)
    {
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            bool isPair = c.Second != ContactPoint.Static;
            if ((c.First != party && c.Second != party) || (!c.Lasts && !(c.IsStruck && graph.RestitutionOf(c) >= 1)))
            {
                continue;
            }

            BodyId partner = bodies.Id(graph.Slots[isPair && c.First == party ? c.Second : c.First]);
            int known = isPair ? timelines.ContactWith(piece, partner) : timelines.ContactWith(piece, c.Surface);
            if (known != TimelineStore.None)
            {
                timelines.Hold(known, c.Lasts);
            }
            else if (c.Lasts)
            {
                timelines.AddContact(piece, new LastingContact(partner, isPair ? LastingContact.NoSurface : c.Surface, holds: true));
            }
        }
    }

}
