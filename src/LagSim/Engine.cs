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

/// <summary>The parts of a simulation, put together.</summary>
/// <remarks>
/// Data goes one way: the loop takes the least key from the scheduler; a handler opens segments of timelines; the predictor looks what they
/// meet, and schedules that. A late event only has the rewinder cut segments, which the loop then makes again.
/// </remarks>
internal sealed class Engine
{
    private readonly EventScheduler scheduler;
    private readonly RollbackState rollback = new();
    private readonly EventPredictor predictor;

    /// <summary>A world without bodies, with room for as many as are expected.</summary>
    internal Engine(Scene scene, SimulationOptions options, SimTime start, SimTime from, int expected)
    {
        EngineParts parts = options.Parts;
        Scene = scene;
        Progress = new Progress(start, options.History, from);
        rollback.Cursor = EventKey.Before(from);
        Bodies = new BodyTable(expected);
        scheduler = new EventScheduler(expected);
        EventLog log = new(expected);
        FreeFlights flights = new(scene.Gravity, scene.RestitutionThreshold, scene.Box, expected, 0.5 * scene.ContactTolerance);
        Timelines = new TimelineStore(start, options.MaxSegments, flights, expected, parts.TimelineGrowthPolicy(start, options.History));
        Timelines.ForgetBefore(from);
        Reader = new StateReader(scene.Box, Bodies, Timelines, Progress);

        // The laws that bodies follow, and where contact is.
        Forces forces = new(scene, start);
        TrajectoryFactory trajectories = new(scene, forces, Bodies, Timelines);
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
            scene, start, Bodies, Timelines, view, memberContacts, strikes, Step.Scale, hasIslands);
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
        CollapseRule collapse = parts.CollapseRule(scene, Bodies, Timelines, graph, strikes);
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
        FilterChange filters = new(scene, Bodies, Timelines, members, trajectories);
        ExternalHandler externals = new(
            scene, Bodies, Timelines, log, flights, graph, waker, members, trajectories, collapse, lonePath, filters, new FreePlaces(scene, Bodies, Timelines, view));
        EventDispatcher dispatcher = new(Progress, graph, predictor, impacts, steps, externals, marks, rewinds, Rewinder);
        Meter = new WorkMeter(Bodies, graph, work, rollback);
        Loop = new EventLoop(
            Progress, Timelines, scheduler, rollback, Rewinder, dispatcher, BroadPhase, Meter, trajectories.Failures,
            options.Cancellation);

        // What comes from outside.
        Roster = new BodyRoster(
            scene, Bodies, Timelines, log, scheduler, Progress, rollback, flights, BroadPhase, trajectories, collapse);
        Intake = new EventIntake(Roster, Bodies, log, Progress, rollback, BroadPhase, predictor, Rewinder, Loop);
    }

    internal Scene Scene { get; }

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

    internal BodyRoster Roster { get; }

    internal EventIntake Intake { get; }

    /// <summary>How far a rollback has come, and what rollbacks have done so far.</summary>
    internal RollbackState Rollback => rollback;

    /// <summary>The last instant that can be read: nothing happens between what is simulated and here.</summary>
    internal SimTime Horizon => scheduler.Count == 0
        ? SimTime.MaxValue
        : SimTime.Max(Progress.SimulatedTo, scheduler.MinKey.Time - SimDuration.OneTick);

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

    /// <summary>Forgets what lies before a time, but nothing that is not simulated yet.</summary>
    internal void DropHistoryBefore(SimTime time)
    {
        Progress.ForgetBefore(SimTime.Min(time, Progress.SimulatedTo));
        Timelines.ForgetBefore(Progress.HistoryEdge);
        BroadPhase.Current.DropBefore(Progress.HistoryEdge);
    }
}
