using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Handlers;

/// <summary>External events: what players do.</summary>
internal sealed class ExternalHandler(
    Scene scene, BodyTable bodies, TimelineStore timelines, EventLog log, FreeFlights flights, ContactGraph graph, SleepWaker waker,
    MemberFactory members, TrajectoryFactory trajectories, CollapseRule collapse, ForwardedPath lonePath, FilterChange filters, FreePlaces places)
{
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Applies the body's event that is due; the graph then has the bodies whose segments follow. False if a body that sleeps on it has to
    /// be rewound first.
    /// </summary>
    internal bool TryHandle(int slot, in EventKey key)
    {
        if (!waker.TryFind(slot, key))
        {
            return false;
        }

        int before = timelines.Last(slot);
        int entry = log.TakeDue(slot);
        Apply(slot, key, log.Event(entry), log.IsForwarded(entry));
        if (timelines.Last(slot) == before)
        {
            graph.Clear();
        }

        waker.Wake(slot, key);
        return true;
    }

    private void Apply(int slot, in EventKey key, in ExternalEvent external, bool isForwarded)
    {
        int last = timelines.Last(slot);
        bool isThere = timelines.Segment(last).IsPresent;
        if (external.Kind == EventKind.Spawn)
        {
            if (!isThere)
            {
                Spawn(slot, key, external, isForwarded);
            }
        }
        else if (!isThere || !EventRights.MayTouch(external, bodies.Players(slot)))
        {
            return; // nothing to act on, now; a late event may still put the body there, and then this is simulated again
        }
        else if (external.Kind == EventKind.Remove)
        {
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.Nothing(key.Time), default);
        }
        else if (external.Kind is EventKind.Grab or EventKind.HoldKeyframe or EventKind.Release)
        {
            collapse.HasLosses |= external.Kind == EventKind.Grab; // a hand gives and takes
            trajectories.Hands.Act(slot, key, external);
        }
        else if (external.Kind == EventKind.SetFilter)
        {
            filters.Open(slot, key, external.Filter);
        }
        else if (paths.IsHeld(last))
        {
            return; // a held body goes where the hand goes
        }
        else if (!places.TryFind(slot, key, external, timelines.Extras.Filter(last), out Vector3D position))
        {
            return; // something is there
        }
        else if (isForwarded)
        {
            lonePath.Follow(slot, key, external, position);
        }
        else
        {
            Push(slot, key, external, position);
        }
    }

    private void Spawn(int slot, in EventKey key, in ExternalEvent external, bool isForwarded)
    {
        bodies.SetSpec(slot, trajectories.Flights.Chosen(external.Spec));
        bodies.SetPlayers(slot, external.Players);
        collapse.HasLosses |= external.Spec.Restitution < 1;
        flights.SetRadius(slot, external.Spec.Radius);
        if (!places.TryFind(slot, key, external, external.Spec.Filter, out Vector3D position))
        {
            return;
        }

        timelines.Extras.OpenWith(external.Spec.Filter);
        if (isForwarded)
        {
            lonePath.Follow(slot, key, external, position);
        }
        else
        {
            trajectories.Flights.Open(slot, key, position, external.Velocity, spin: external.Spin.WithoutNegativeZero());
        }
    }

    /// <summary>An impulse, a new velocity, or a teleport to a place.</summary>
    private void Push(int slot, in EventKey key, in ExternalEvent external, in Vector3D place)
    {
        int last = timelines.Last(slot);
        double seconds = paths.SecondsInto(last, key.Time);
        SupportSet supports = timelines.Segment(last).Supports;
        if (!ActionEffects.TryApply(external, place, timelines.Segment(last), timelines.Dense(last), seconds, bodies.Spec(slot).Mass, scene,
            out Vector3D position, out Vector3D velocity))
        {
            return;
        }

        Vector3D spin = timelines.SpinOf(last).At(seconds);
        if (paths.IsMember(last) && external.Kind != EventKind.Teleport)
        {
            if (members.TryGoOn(slot, key, position, velocity, spin, hasChanged: true))
            {
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }

            return;
        }

        Span<int> carriers = stackalloc int[SupportSet.Most];
        int count = external.Kind == EventKind.Teleport ? 0 : supports.Count;
        for (int k = 0; k < count; k++)
        {
            carriers[k] = supports[k];
        }

        trajectories.Open(slot, key, position, velocity, 0, carriers.Slice(0, count), spin);
    }
}
