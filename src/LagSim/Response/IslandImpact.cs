using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Response;

/// <summary>
/// Impacts that reach islands, or begin them: an impulse spreads over persistent contacts as far as it changes velocities.
/// </summary>
internal sealed class IslandImpact(
    Scene scene, BodyTable bodies, TimelineStore timelines, RewindRequests rewinds, ContactGraph graph, ContactScale scale,
    IslandImpactProblem impact, Partners partners, MemberContacts memberContacts, SlipFactory friction,
    ImpactNotifier notifier, IslandImpactSegments segments, HandBlows blows)
{
    /// <summary>
    /// One sweep to and one fro, while an impact still reaches more bodies: how far it goes shows in its first sweeps, and it is solved to
    /// the end once it reaches no other body.
    /// </summary>
    private const int GrowingSweeps = 2;

    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly Paths paths = new(timelines);

    /// <summary>Whether the impact of the graph reaches an island, or begins one: also where a hand cannot give what it takes.</summary>
    internal bool Reaches(SimTime time)
    {
        bool reaches = graph.HasHand() && blows.MayPress(time);
        for (int i = 0; i < graph.BodyCount && !reaches; i++)
        {
            reaches = paths.IsMember(timelines.Last(graph.Slots[i]));
        }

        for (int i = 0; i < graph.ContactCount && !reaches; i++)
        {
            reaches = graph.Contacts[i].Lasts;
        }

        return reaches;
    }

    /// <summary>Solves the impact of the graph with the persistent contacts that it reaches.</summary>
    /// <param name="popped">The impact's key.</param>
    /// <param name="residual">Seconds from the tick to the impact.</param>
    /// <param name="presses">
    /// Whether to press what a hand strikes against the static surfaces that are within the contact tolerance on its way: bounces with less
    /// room than that are left out.
    /// </param>
    internal ImpactOutcome Handle(in EventKey popped, double residual, bool presses)
    {
        EventKey key = graph.CanonicalKey(popped);
        int struckBodies = graph.BodyCount;
        Begin(key.Time);
        bool isNear = Spread(key, residual, presses);
        if (!rewinds.AreNone)
        {
            return ImpactOutcome.NeedsRewind;
        }

        if (presses && !(isNear && IsJammed()))
        {
            for (int i = struckBodies; i < graph.BodyCount; i++)
            {
                partners.NearMisses.Add(graph.Slots[i]);
            }

            graph.KeepBodies(struckBodies);
            return ImpactOutcome.GivesWay;
        }

        notifier.Tell(key);
        impact.ShareHands(scale.SweepSpeed);
        impact.DropReboundsThatGain(scale.SweepSpeed);
        if (CollapseRule.IsOverlong(key))
        {
            impact.JoinWhatCloses(StrikeCounts.CollapseSpeed);
        }

        KeepPressed(isNear);
        segments.Open(key, residual);
        return ImpactOutcome.Done;
    }

    /// <summary>The impulse begins at the bodies struck and at those that carry them.</summary>
    private void Begin(SimTime time)
    {
        impact.Clear();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            AddBody(i, time);
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            ref SolverContact added = ref impact.Problem.AddContact(
                c.First, c.Second, c.Surface, c.Normal, graph.GapOf(c), graph.FrictionOf(c), graph.RollingLeverOf(c));
            added.Target = c.Target;
        }

        AddSupports();
    }

    /// <summary>
    /// Solves again and again, as long as the impulse reaches more; whether it presses a body against a surface that is near.
    /// </summary>
    private bool Spread(in EventKey key, double residual, bool presses)
    {
        double tolerance = scale.SweepSpeed;
        double more = scale.Pull * scale.Step.ToSeconds();
        impact.LimitHands(more);
        impact.Solve(tolerance, GrowingSweeps, 0, 0);
        bool isNear = false;
        bool isSolved = false;
        for (bool goesOn = true; goesOn && rewinds.AreNone;)
        {
            bool grows = false;
            bool hasHand = graph.HasHand();
            int known = graph.BodyCount;
            int knownContacts = impact.Problem.ContactCount;
            for (int i = 0; i < known; i++)
            {
                if (!impact.IsReached(i) && impact.ChangeOf(i).Length > scale.ReachSpeed)
                {
                    impact.Reach(i);
                    grows |= TryReachOn(i, key, residual, presses);
                }
            }

            for (int i = 0; i < known && rewinds.AreNone && hasHand; i++)
            {
                if (TryReachNear(i, key.Time, tolerance))
                {
                    isNear = true;
                    grows = true;
                }
            }

            goesOn = grows || !isSolved; // what it was solved to may reach others yet
            if (goesOn && rewinds.AreNone)
            {
                impact.LimitHands(more);
                impact.Solve(tolerance, grows ? GrowingSweeps : ContactStep.MaxSweeps, known, knownContacts);
                isSolved = !grows;
            }
        }

        return isNear;
    }

    /// <summary>Whether what a hand strikes is pressed against a static surface.</summary>
    private bool IsJammed()
    {
        bool isJammed = false;
        for (int i = graph.ContactCount; i < impact.Problem.ContactCount && !isJammed; i++)
        {
            ref readonly SolverContact c = ref impact.Problem.Contacts[i];
            isJammed = c.Impulse > 0 && c.Second == ContactPoint.Static;
        }

        return isJammed;
    }

    /// <summary>
    /// Contacts that a hand presses with all it may give persist, and so do those that they are pressed against. So do contacts that were
    /// to rebound and do not, since that would have made energy.
    /// </summary>
    private void KeepPressed(bool presses)
    {
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly SolverContact c = ref impact.Problem.Contacts[i];
            bool isDropped = impact.KeepsWhatDoesNotRebound && graph.Contacts[i].Target > 0 && c.Target <= 0 && c.Impulse > 0 && graph.RestitutionOf(graph.Contacts[i]) < 1;
            graph.Contacts[i].Lasts |= isDropped || (graph.IsByHand(graph.Contacts[i]) && c.Impulse >= c.Most);
        }

        for (int i = graph.ContactCount; i < impact.Problem.ContactCount && presses; i++)
        {
            ref readonly SolverContact c = ref impact.Problem.Contacts[i];
            if (c.Impulse > 0)
            {
                graph.AddContact(new ContactPoint(c.First, c.Second, c.Surface, default) { Normal = c.Normal, IsStruck = false, Lasts = true });
            }
        }
    }

    /// <summary>
    /// Adds the static surfaces that a body is pushed towards and would reach within the contact tolerance. Not other bodies: that one is
    /// near without being struck no rollback would find.
    /// </summary>
    private bool TryReachNear(int body, SimTime time, double tolerance)
    {
        Vector3D push = impact.ChangeOf(body);
        if (double.IsPositiveInfinity(graph.Masses[body]) || push.Length <= tolerance)
        {
            return false;
        }

        double left = scale.TickFrom(time, double.PositiveInfinity).SecondsSince(time);
        bool any = false;
        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            ContactPoint c = new(body, ContactPoint.Static, surface, default);
            if (!impact.Has(c) && filters.MeetSurface(timelines.Last(graph.Slots[body]), surface) && Vector3D.Dot(graph.NormalOf(c), push) < -tolerance && graph.GapOf(c) <= scale.Length)
            {
                AddContact(c, left);
                any = true;
            }
        }

        return any;
    }

    /// <summary>
    /// Adds the persistent contacts of a body whose velocity the impact has changed, and the bodies on their other sides.
    /// </summary>
    private bool TryReachOn(int body, in EventKey key, double residual, bool presses)
    {
        int slot = graph.Slots[body];
        int piece = timelines.Last(slot);
        if (!paths.IsMember(piece))
        {
            return false;
        }

        bool any = false;
        ref readonly MotionSegment path = ref timelines.Segment(piece);
        SimTime end = path.Law == MotionLaw.Resting ? scale.TickFrom(key.Time, double.PositiveInfinity) : path.End;
        double left = end.SecondsSince(key.Time);
        for (int at = timelines.Carried.First(piece); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            PersistentContact contact = timelines.Carried.At(at);
            if (!contact.Holds || (!presses && memberContacts.IsElastic(slot, contact)))
            {
                continue; // the room to close in is not used up yet, or an impact will come at the right time
            }

            any |= contact.Surface != PersistentContact.NoSurface
                ? TryReachSurface(body, contact.Surface, left)
                : TryReachPartner(body, contact.Partner, key, residual, left);
        }

        return any;
    }

    private bool TryReachSurface(int body, int surface, double left)
    {
        bool isNew = !graph.HasContact(body, surface) && filters.MeetSurface(timelines.Last(graph.Slots[body]), surface);
        if (isNew)
        {
            AddContact(new ContactPoint(body, ContactPoint.Static, surface, default), left);
        }

        return isNew;
    }

    private bool TryReachPartner(int body, BodyId partnerId, in EventKey key, double residual, double left)
    {
        BodyId id = bodies.Id(graph.Slots[body]);
        if (!partners.TryFind(id, partnerId, key, out int partner))
        {
            return false;
        }

        int other = graph.IndexOf(partner);
        if (other >= 0 && ((impact.IsReached(other) && !double.IsPositiveInfinity(graph.Masses[other])) || graph.HasPair(body, other)))
        {
            return false; // it has added the contact, or the two were struck
        }

        if (other < 0)
        {
            other = graph.AddBody(partner);
            graph.Evaluate(other, key.Time, residual);
            AddBody(other, key.Time);
        }

        bool ordered = id < partnerId;
        AddContact(new ContactPoint(ordered ? body : other, ordered ? other : body, -1, default), left);
        return true;
    }

    private void AddBody(int body, SimTime time)
    {
        impact.AddBody(graph.Masses[body], graph.Radii[body], graph.Velocities[body], graph.Spins[body]);
        if (double.IsPositiveInfinity(graph.Masses[body]))
        {
            impact.Problem.HandRoom(body) = blows.Room(body, time);
        }
    }

    /// <summary>The surfaces that carry a body by a closed form hold it up while it is struck.</summary>
    private void AddSupports()
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            SupportSet supports = timelines.Segment(timelines.Last(graph.Slots[i])).Supports;
            for (int k = 0; k < supports.Count; k++)
            {
                if (!graph.HasContact(i, supports[k]))
                {
                    double coefficient = friction.On(graph.Slots[i], supports[k]);
                    double lever = Math.Min(bodies.Spec(graph.Slots[i]).RollingResistance, coefficient) * graph.Radii[i];
                    impact.Problem.AddContact(i, ContactPoint.Static, supports[k], surfaces.Plane(supports[k]).Normal, 0, coefficient, lever);
                }
            }
        }
    }

    private void AddContact(ContactPoint c, double left)
    {
        c.Normal = graph.NormalOf(c);
        double gap = graph.GapOf(c);
        ref SolverContact added = ref impact.Problem.AddContact(
            c.First, c.Second, c.Surface, c.Normal, gap, graph.FrictionOf(c), graph.RollingLeverOf(c));
        added.Target = gap > 0 && left > 0 ? -gap / left : 0;
    }
}
