using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Response;

/// <summary>
/// Opens the segments on which bodies leave an impact that has reached an island, with the contacts that last from there on.
/// </summary>
internal sealed class IslandImpactSegments(
    BodyTable bodies, TimelineStore timelines, ContactGraph graph, IslandImpactProblem impact, MemberFactory members,
    MemberContacts memberContacts, TrajectoryFactory trajectories, FreeImpactResponse resolver, ImpactSegments alone, ClosedInstants closed)
{
    private readonly Paths paths = new(timelines);

    /// <summary>Opens those of all bodies of the graph, whose impact is solved.</summary>
    /// <param name="key">The impact.</param>
    /// <param name="residual">Seconds from the tick to the impact.</param>
    internal void Open(in EventKey key, double residual)
    {
        closed.Before();
        SimTime end = SimTime.MaxValue; // of the step in which the island is
        for (int i = 0; i < graph.BodyCount; i++)
        {
            ref readonly MotionSegment path = ref timelines.Segment(timelines.Last(graph.Slots[i]));
            end = path.Law == MotionLaw.Constrained ? SimTime.Min(end, path.End) : end;
            graph.Velocities[i] = impact.Problem.Bodies[i].Velocity;
            graph.Spins[i] = impact.Problem.Bodies[i].Spin;
        }

        resolver.LimitSpeeds();
        closed.After();
        graph.List();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            int before = timelines.Last(graph.Slots[i]);
            if (paths.IsHeld(before))
            {
                trajectories.Hands.GoOn(graph.Slots[i], key, ContactSolver.GivenBy(impact.Problem, i), graph.Velocities[i].Length);
            }
            else if (!paths.IsMember(before) && !HasPersistentContact(i))
            {
                alone.Open(i, key, residual);
            }
            else
            {
                OpenMember(i, key, graph.Positions[i] - (graph.Velocities[i] * residual), end);
            }
        }
    }

    private void OpenMember(int body, in EventKey key, in Vector3D position, SimTime end)
    {
        int slot = graph.Slots[body];
        int before = timelines.Last(slot);
        if (paths.IsMember(before))
        {
            bool hasChanged = HasPersistentContact(body) || impact.HasChanged(body, graph.Velocities[body], graph.Spins[body]);
            if (!members.TryGoOn(slot, key, position, graph.Velocities[body], graph.Spins[body], hasChanged))
            {
                return;
            }
        }
        else
        {
            SupportSet supports = timelines.Segment(before).Supports;
            SimTime tick = members.NextTick(slot, key.Time, members.StepWanted(slot, key.Time, position, graph.Velocities[body], graph.Spins[body]));
            SimTime until = end == SimTime.MaxValue ? tick : SimTime.Min(end, tick > key.Time ? tick : end);
            if (!members.TryOpenChord(slot, key, until, position, graph.Velocities[body], graph.Spins[body]))
            {
                return;
            }

            timelines.BeginMember(timelines.Last(slot), key.Time, key.Time);
            for (int k = 0; k < supports.Count; k++)
            {
                timelines.Carried.Add(timelines.Last(slot), new PersistentContact(bodies.Id(slot), supports[k], holds: true));
            }
        }

        AddPersistentContact(body, timelines.Last(slot));
        if (TouchesHand(timelines.Last(slot)))
        {
            LeaveSurfacesToStep(slot);
        }

        timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
    }

    private bool HasPersistentContact(int body)
    {
        bool has = false;
        foreach (int i in graph.ListOf(body))
        {
            has |= graph.Contacts[i].Lasts;
        }

        return has;
    }

    /// <summary>
    /// A member's new segment carries the contacts of the impact that last from here on; those that bounced off without a loss hold no
    /// more.
    /// </summary>
    private void AddPersistentContact(int body, int piece)
    {
        foreach (int i in graph.ListOf(body))
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            bool isPair = c.Second != ContactPoint.Static;
            if (!c.Lasts && !(c.IsStruck && graph.RestitutionOf(c) >= 1))
            {
                continue;
            }

            BodyId partner = bodies.Id(graph.Slots[isPair && c.First == body ? c.Second : c.First]);
            int known = isPair ? timelines.Carried.With(piece, partner) : timelines.Carried.With(piece, c.Surface);
            if (known != TimelineStore.None)
            {
                timelines.Carried.Hold(known, c.Lasts);
            }
            else if (c.Lasts)
            {
                timelines.Carried.Add(piece, new PersistentContact(partner, isPair ? PersistentContact.NoSurface : c.Surface, holds: true));
            }
        }
    }

    /// <summary>Whether a member carries a contact with a hand of the impact.</summary>
    private bool TouchesHand(int piece)
    {
        bool touches = false;
        for (int at = timelines.Carried.First(piece); at != TimelineStore.None && !touches; at = timelines.Carried.Next(at))
        {
            ref readonly PersistentContact contact = ref timelines.Carried.At(at);
            int partner = contact.Surface == PersistentContact.NoSurface ? bodies.SlotOf(contact.Partner) : -1;
            touches = partner >= 0 && graph.IndexOf(partner) >= 0 && paths.IsHeld(timelines.Last(partner));
        }

        return touches;
    }

    /// <summary>
    /// What a hand's impact has solved it may press no further: surfaces that hold are left to the step, except elastic ones, which impacts
    /// do not pass over.
    /// </summary>
    private void LeaveSurfacesToStep(int slot)
    {
        for (int at = timelines.Carried.First(timelines.Last(slot)); at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            ref readonly PersistentContact contact = ref timelines.Carried.At(at);
            if (contact.Surface != PersistentContact.NoSurface && contact.Holds && !memberContacts.IsElastic(slot, contact))
            {
                timelines.Carried.Solve(at);
            }
        }
    }
}
