using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim;

/// <summary>Adds bodies to every part that keeps something for each body, and forgets those that are gone for good.</summary>
internal sealed class BodyRoster(
    Scene scene, BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress,
    RollbackState rollback, FreeFlights flights, AdaptiveBroadPhase broadPhase, TrajectoryFactory trajectories, CollapseRule collapse)
{
    /// <summary>The crossings of sensors; null in a scene without.</summary>
    internal CrossingLog? Crossings { get; set; }

    /// <summary>Adds a body of the scene, on the first segment of its flight.</summary>
    /// <exception cref="SimulationException">The body cannot be followed from its start on, which is the scene's fault.</exception>
    internal void AddFromScene(int n)
    {
        ref readonly SceneBody body = ref scene.BodyArray[n];
        int slot = Add(BodyId.OfScene(n), body.Spec);
        collapse.HasLosses |= body.Spec.Restitution < 1;
        timelines.Extras.OpenWith(body.Spec.Filter);
        EventKey key = new(progress.Start, 0, EventKind.Start, bodies.Id(slot), bodies.Id(slot), 0, 0);
        trajectories.Flights.Open(slot, key, body.Position, body.Velocity, spin: body.Spin);
        LossReason loss = timelines.Segment(timelines.Last(slot)).Loss;
        if (loss != LossReason.None)
        {
            throw new SimulationException(trajectories.Failures.OfLoss(slot, progress.Start, loss, body.Position, body.Velocity, body.Spin));
        }
    }

    /// <summary>Adds a body of a snapshot, on the segment on which it is there.</summary>
    internal void AddFromSnapshot(in BodySnapshot body)
    {
        int slot = Add(body.Id, body.Spec);
        bodies.SetPlayers(slot, body.Players);
        collapse.HasLosses |= body.Spec.Restitution < 1 || body.Segment.Law == MotionLaw.Held;
        timelines.Extras.OpenWith(body.Filter);
        timelines.Append(slot, body.Id, body.Opened, body.Segment, body.Dense, body.Hold, body.SpinPath);
        if (body.Segment.IsOfIsland)
        {
            int piece = timelines.Last(slot);
            timelines.BeginMember(piece, body.Centre, body.StillSince);
            foreach (PersistentContact contact in body.ContactArray)
            {
                timelines.Carried.Add(piece, contact);
            }

            timelines.EndMember(piece, body.Id);
        }

        Crossings?.Begin(slot, body.InsideArray, body.CrossingArray);
    }

    /// <summary>Adds a body that an external event names and that is not there yet.</summary>
    /// <returns>Its slot.</returns>
    internal int AddAbsent(BodyId id)
    {
        int slot = Add(id);
        timelines.Append(slot, id, EventKey.Before(progress.Start), MotionSegment.Nothing(progress.Start), default);
        return slot;
    }

    private int Add(BodyId id, BodySpec spec = default)
    {
        if (bodies.IsFull)
        {
            bodies.Forget(ForgetIfAbsent);
        }

        int slot = bodies.Add(id, spec);
        scheduler.AddSlot(slot);
        rollback.AddSlot(slot);
        timelines.AddSlot(slot);
        flights.AddSlot(slot, spec.Radius);
        log.AddSlot(slot);
        Crossings?.AddSlot(slot);
        return slot;
    }

    /// <summary>
    /// Forgets the timeline of a body that is not there and that nothing inside the window refers to; false for any other.
    /// </summary>
    private bool ForgetIfAbsent(int slot)
    {
        log.DropBefore(slot, progress.HistoryEdge);
        timelines.DropBefore(slot, progress.HistoryEdge);
        int last = timelines.Last(slot);
        bool isGone = log.IsEmpty(slot) && !timelines.Segment(last).IsPresent && timelines.Key(last).Time < progress.HistoryEdge;
        if (isGone)
        {
            timelines.Forget(slot);
            Crossings?.Forget(slot);
            broadPhase.Current.Forget(slot);
        }

        return isGone;
    }
}
