using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Handlers;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim;

/// <summary>
/// The parts of a simulation, put together; and what concerns all of them: adding bodies and events, and forgetting bodies.
/// </summary>
/// <remarks>
/// Data goes one way: the loop takes the least key from the scheduler; a handler opens segments of timelines; the predictor looks what they
/// meet, and schedules that. A late event only has the rewinder cut segments, which the loop then makes again.
/// </remarks>
internal sealed class Engine
{
    private readonly EventLog log;
    private readonly EventScheduler scheduler;
    private readonly FreeFlights flights;
    private readonly CollapseRule collapse;
    private readonly TrajectoryFactory trajectories;
    private readonly RollbackState rollback = new();
    private readonly EventPredictor predictor;

    /// <summary>A world without bodies, with room for as many as are expected; what none of them may need is made when one does.</summary>
    internal Engine(Scene scene, SimulationOptions options, SimTime start, SimTime from, int expected)
    {
        EngineParts parts = options.Parts;
        Scene = scene;
        Threads = options.Threads;
        Progress = new Progress(start, options.History, from);
        rollback.Cursor = EventKey.Before(from);
        Bodies = new BodyTable(expected);
        scheduler = new EventScheduler(expected);
        log = new EventLog(expected);
        flights = new FreeFlights(scene.Gravity, scene.RestitutionThreshold, scene.Box, expected, 0.5 * scene.ContactTolerance);
        Timelines = new TimelineStore(start, options.MaxSegments, flights, expected, parts.TimelineGrowthPolicy(start, options.History));
        Timelines.ForgetBefore(from);
        Reader = new StateReader(scene.Box, Bodies, Timelines, Progress);

        // The laws that bodies follow, and where contact is.
        Forces forces = new(scene, start);
        trajectories = new TrajectoryFactory(scene, forces, Bodies, Timelines);
        bool hasIslands = parts.HasIslands(scene);
        Step = new ContactStep(scene, parts.ContactScale(scene, start), parts.SolverRules);
        ContactGraph graph = new(Bodies, Timelines, scene.Surfaces, scene.Box);
        SolverWork work = new();

        // The next event of a body.
        SegmentLookup view = parts.SegmentLookup(Timelines, rollback);
        StepMarks marks = new();
        StrikeCounts strikes = new(Timelines, Bodies, scene.Surfaces, scene.Box);
        MemberContacts memberContacts = new(Timelines, view, Bodies, scene.Surfaces, Step.Scale);
        CollisionPredictor collisions = new(
            scene, start, Bodies, Timelines, rollback, view, memberContacts, strikes, Step.Scale, hasIslands);
        CollisionSearch search = parts.CollisionSearch(Bodies, Timelines, flights, scene.Surfaces, collisions, marks);
        BroadPhase = parts.BroadPhase(scene, Bodies, Timelines, options.BruteForceLimit);
        predictor = parts.EventPredictor(Bodies, Timelines, log, scheduler, rollback, flights, BroadPhase, search, view);

        // Rewinding for late events.
        RewindRequests rewinds = new();
        Reconvergence = new Reconvergence(Bodies, Timelines, log, scheduler, Progress, rollback, BroadPhase, predictor, parts.CutPaths())
        {
            Observer = options.Observer,
        };
        Rewinder = parts.Rewinder(Bodies, Timelines, log, scheduler, Progress, rollback, Reconvergence, predictor, options.Healing);

        // Islands.
        Partners partners = new(Bodies, Timelines, view, rewinds);
        MemberFactory members = new(Bodies, Timelines, forces, Step.Scale, trajectories);
        SleepWaker waker = parts.SleepWaker(Bodies, Timelines, view, graph, rewinds, members);
        IslandSleep sleep = new(Bodies, Timelines, graph, Step);
        StepSegments stepSegments = new(scene, Bodies, Timelines, graph, Step, members, trajectories, sleep);
        Stepper = new IslandStepper(Bodies, Timelines, forces, graph, Step, partners, rewinds, members, stepSegments, sleep, marks, work);

        // The handlers of events.
        collapse = parts.CollapseRule(scene, Bodies, Timelines, graph, strikes);
        CaptureRule capture = new(scene, Timelines, graph, Step.Scale, members, trajectories.Friction, hasIslands);
        FreeImpactResponse resolver = new(scene, Bodies, Timelines, graph, capture, collapse);
        ImpactNotifier notifier = new(Bodies, Timelines, graph);
        ImpactSegments segments = new(Timelines, graph, trajectories);
        SegmentLinker linker = parts.SegmentLinker(Bodies, Timelines, graph, partners, members);
        Isolated = parts.IsolatedImpact(
            scene, Bodies, Timelines, scheduler, rollback, flights, graph, resolver, notifier, segments);
        ImpactGraphBuilder builder = parts.ImpactGraphBuilder(
            scene, Bodies, Timelines, rollback, rewinds, view, flights, BroadPhase, collisions, collapse, graph);
        IslandImpactProblem problem = new(Step, work);
        IslandImpactSegments memberSegments = new(Bodies, Timelines, graph, problem, members, trajectories, resolver, segments);
        IslandImpact island = new(
            scene, Bodies, Timelines, rewinds, graph, Step.Scale, problem, partners, memberContacts, capture, trajectories.Friction, notifier,
            memberSegments);
        ImpactHandler impacts = new(scene, Bodies, graph, partners, Isolated, builder, resolver, island, notifier, segments, linker);
        StepEndHandler steps = new(Timelines, graph, Stepper, trajectories, linker);
        ForwardedPath lonePath = new(scene, Bodies, Timelines, new SingleBodyWorld(scene, start, options.MaxSegments));
        ExternalHandler externals = new(
            scene, Bodies, Timelines, log, flights, graph, waker, members, trajectories, collapse, lonePath);
        EventDispatcher dispatcher = new(Progress, graph, predictor, impacts, steps, externals, marks, rewinds, Rewinder);
        Meter = new WorkMeter(Bodies, graph, work, rollback);
        Loop = new EventLoop(
            Progress, Timelines, scheduler, rollback, Rewinder, dispatcher, BroadPhase, Meter, trajectories.Failures,
            options.Cancellation);
    }

    internal Scene Scene { get; }

    /// <summary>The largest number of threads that work for it.</summary>
    internal int Threads { get; }

    internal Progress Progress { get; }

    internal BodyTable Bodies { get; }

    internal TimelineStore Timelines { get; }

    internal StateReader Reader { get; }

    internal ContactStep Step { get; }

    internal AdaptiveBroadPhase BroadPhase { get; }

    internal IslandStepper Stepper { get; }

    internal IsolatedImpact Isolated { get; }

    internal Reconvergence Reconvergence { get; }

    internal Rewinder Rewinder { get; }

    internal WorkMeter Meter { get; }

    internal EventLoop Loop { get; }

    /// <summary>How far a rollback has come, and what rollbacks have done so far.</summary>
    internal RollbackState Rollback => rollback;

    /// <summary>The last instant that can be read: nothing happens between what is simulated and here.</summary>
    internal SimTime Horizon => scheduler.Count == 0
        ? SimTime.MaxValue
        : SimTime.Max(Progress.SimulatedTo, scheduler.MinKey.Time - SimDuration.OneTick);

    /// <summary>Adds a body of the scene, on the first segment of its flight.</summary>
    internal void AddFromScene(int n)
    {
        ref readonly SceneBody body = ref Scene.BodyArray[n];
        int slot = AddBody(BodyId.OfScene(n), body.Spec);
        collapse.HasLosses |= body.Spec.Restitution < 1;
        EventKey key = new(Progress.Start, 0, EventKind.Start, Bodies.Id(slot), Bodies.Id(slot), 0, 0);
        trajectories.Flights.Open(slot, key, body.Position, body.Velocity, spin: body.Spin);
    }

    /// <summary>Adds a body of a snapshot, on the segment on which it is there.</summary>
    internal void AddFromSnapshot(in BodySnapshot body)
    {
        int slot = AddBody(body.Id, body.Spec);
        collapse.HasLosses |= body.Spec.Restitution < 1 || body.Segment.Law == MotionLaw.Held;
        Timelines.Append(slot, body.Id, body.Opened, body.Segment, body.Dense, body.Hold, body.SpinPath);
        if (body.Segment.IsOfIsland)
        {
            int piece = Timelines.Last(slot);
            Timelines.BeginMember(piece, body.Centre, body.StillSince);
            foreach (PersistentContact contact in body.ContactArray)
            {
                Timelines.Carried.Add(piece, contact);
            }

            Timelines.EndMember(piece, body.Id);
        }
    }

    /// <summary>All bodies that are there at first have been added: what they meet is predicted.</summary>
    internal void Begin()
    {
        BroadPhase.Begin();
        for (int slot = 0; slot < Bodies.SlotCount; slot++)
        {
            Loop.ThrowIfCancelled();
            predictor.Predict(slot);
        }
    }

    /// <summary>Adds an external event at a key, and marks what it changes of what is known already.</summary>
    internal SubmitResult Insert(in ExternalEvent external, in EventKey key, bool isForwarded)
    {
        if (key.Time < Progress.HistoryEdge)
        {
            return SubmitResult.TooOld;
        }

        int slot = Bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            slot = AddBody(external.Body);
            Timelines.Append(slot, external.Body, EventKey.Before(Progress.Start), MotionSegment.Nothing(Progress.Start), default);
            FitBroadPhase();
        }

        log.DropBefore(slot, Progress.HistoryEdge);
        if (!log.TryAdd(slot, external, key, isForwarded))
        {
            return SubmitResult.Duplicate;
        }

        Loop.Reconsider(key.Time);
        if (Rewinder.IsKnown(key))
        {
            Rewinder.Mark(slot, key);
            return SubmitResult.RolledBack;
        }

        int next = log.Due(slot);
        if (next == EventLog.None || EventKey.Compare(key, log.Key(next)) < 0)
        {
            log.SetDueFrom(slot, key);
            predictor.Predict(slot);
        }

        return SubmitResult.Queued;
    }

    /// <summary>Retracts an external event; false if it is not there (any more).</summary>
    internal bool Retract(in ExternalEvent external)
    {
        int slot = Bodies.SlotOf(external.Body);
        if (slot < 0)
        {
            return false;
        }

        log.DropBefore(slot, Progress.HistoryEdge); // what is older can no longer be changed
        int next = log.Due(slot);
        EventKey due = next == EventLog.None ? EventKey.Before(Progress.Start) : log.Key(next);
        if (!log.TryRemove(slot, external.Peer, external.Sequence, out EventKey key))
        {
            return false;
        }

        Loop.Reconsider(key.Time);
        if (key == due && log.Due(slot) == next) // otherwise an earlier one is due again
        {
            log.SetDueFrom(slot, key);
        }

        if (Rewinder.IsKnown(key))
        {
            Rewinder.Mark(slot, key);
        }
        else if (key == due)
        {
            predictor.Predict(slot);
        }

        return true;
    }

    /// <summary>Forgets what lies before a time, but nothing that is not simulated yet.</summary>
    internal void DropHistoryBefore(SimTime time)
    {
        Progress.ForgetBefore(SimTime.Min(time, Progress.SimulatedTo));
        Timelines.ForgetBefore(Progress.HistoryEdge);
        BroadPhase.Current.DropBefore(Progress.HistoryEdge);
    }

    private void FitBroadPhase()
    {
        if (!BroadPhase.IsOutgrown)
        {
            return;
        }

        if (!rollback.IsActive && rollback.Cursor.Time <= Progress.SimulatedTo)
        {
            // The cursor is at the last event, which may be long ago, and no body would be listed between then and now.
            rollback.Cursor = EventKey.Before(Progress.SimulatedTo + SimDuration.OneTick);
        }

        BroadPhase.Rebuild(Progress.HistoryEdge, rollback.Cursor.Time);
        foreach (int slot in Bodies)
        {
            predictor.Predict(slot);
        }
    }

    private int AddBody(BodyId id, BodySpec spec = default)
    {
        if (Bodies.IsFull)
        {
            Bodies.Forget(ForgetIfAbsent);
        }

        int slot = Bodies.Add(id, spec);
        scheduler.AddSlot(slot);
        rollback.AddSlot(slot);
        Timelines.AddSlot(slot);
        flights.AddSlot(slot, spec.Radius);
        log.AddSlot(slot);
        return slot;
    }

    /// <summary>
    /// Forgets the timeline of a body that is not there and that nothing inside the window refers to; false for any other.
    /// </summary>
    private bool ForgetIfAbsent(int slot)
    {
        log.DropBefore(slot, Progress.HistoryEdge);
        Timelines.DropBefore(slot, Progress.HistoryEdge);
        int last = Timelines.Last(slot);
        bool isGone = log.IsEmpty(slot) && !Timelines.Segment(last).IsPresent && Timelines.Key(last).Time < Progress.HistoryEdge;
        if (isGone)
        {
            Timelines.Forget(slot);
            BroadPhase.Current.Forget(slot);
        }

        return isGone;
    }
}
