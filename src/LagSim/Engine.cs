using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Handlers;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Rules;
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
    private readonly Agenda agenda;
    private readonly ILossObserver? lossObserver;

    /// <summary>A world without bodies, with room for as many as are expected.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="options">How it is run.</param>
    /// <param name="start">When the scene began.</param>
    /// <param name="from">From when the world is simulated.</param>
    /// <param name="expected">How many bodies are expected.</param>
    /// <param name="ruleState">The state of its rules, encoded; null for that at the start.</param>
    internal Engine(Scene scene, SimulationOptions options, SimTime start, SimTime from, int expected, byte[]? ruleState = null)
    {
        EngineParts parts = options.Parts;
        Scene = scene;
        lossObserver = options.LossObserver;
        Progress = new Progress(start, options.History, from);
        rollback.Cursor = EventKey.Before(from);
        Bodies = new BodyTable(expected);
        scheduler = new EventScheduler(expected);
        EventLog log = new(expected);
        FreeFlights flights = new(scene.Gravity, scene.RestitutionThreshold, scene.Box, expected, 0.5 * scene.ContactTolerance);
        Timelines = new TimelineStore(start, options.MaxSegments, flights, expected, parts.TimelineGrowthPolicy(start, options.History));
        Timelines.ForgetBefore(from);
        RuleMemory? ruleMemory = scene.Rules is null ? null : new RuleMemory(scene.Rules);
        Rules = ruleMemory is null ? null : parts.RuleLog(scene, start, ruleState ?? ruleMemory.Begin());
        if (Rules is not null)
        {
            Rules.Running = options.RunningRuleCall;
        }

        Reader = new StateReader(scene.Box, Bodies, Timelines, Progress, Rules);

        // The laws that bodies follow, and where contact is.
        Forces forces = new(scene, start);
        TrajectoryFactory trajectories = new(scene, forces, Bodies, Timelines);
        Losses = new LossReader(Bodies, Timelines, trajectories.Failures);
        bool hasIslands = parts.HasIslands(scene);
        Step = new ContactStep(scene, parts.ContactScale(scene, start), parts.SolverRules);
        ContactGraph graph = new(Bodies, Timelines, scene.Surfaces, scene.Box);
        EventWork work = new();

        // The next event of a body.
        SegmentLookup view = parts.SegmentLookup(Timelines, rollback);
        StepMarks marks = new();
        StrikeCounts strikes = new(Timelines, Bodies, scene.Surfaces, scene.Box);
        MemberContacts memberContacts = new(Timelines, Bodies, scene.Surfaces, Step.Scale);
        CollisionPredictor collisions = new(
            scene, start, Bodies, Timelines, memberContacts, strikes, Step.Scale, work, hasIslands);
        CollisionSearch search = parts.CollisionSearch(Bodies, Timelines, flights, scene.Surfaces, collisions, view, marks, work);
        BroadPhase = parts.BroadPhase(scene, Bodies, Timelines, options.BruteForceLimit);
        predictor = parts.EventPredictor(Bodies, Timelines, log, scheduler, rollback, flights, BroadPhase, search, view);

        // Rewinding for late events.
        RewindRequests rewinds = new();
        Reconvergence = new Reconvergence(Bodies, Timelines, log, scheduler, Progress, rollback, BroadPhase, predictor, parts.CutPaths())
        {
            Observer = options.Observer,
            Rules = Rules,
        };
        Rewinder = parts.Rewinder(Bodies, Timelines, log, scheduler, Progress, rollback, Reconvergence, predictor, options.Healing);
        Rewinder.Rules = Rules;

        // Sensors.
        CrossingHandler? crossingHandler = null;
        if (scene.SensorArray.Length > 0)
        {
            Crossings = new CrossingLog(scene.SensorArray.Length, Bodies, Timelines, Progress);
            Reader.Crossings = Crossings;
            Rewinder.Sensors = new SensorDependencies(scene, Bodies, Crossings);
            predictor.Crossings = parts.CrossingPredictor(scene, start, Bodies, Timelines, view, Crossings);
            Reconvergence.Keep(parts.CutCrossings(Crossings));
            Reconvergence.CrossingObserver = options.CrossingObserver;
            crossingHandler = new CrossingHandler(scene, Bodies, Timelines, Crossings, graph, rewinds);
        }

        // Islands.
        Partners partners = new(Bodies, Timelines, view, rewinds);
        MemberFactory members = parts.MemberFactory(Bodies, Timelines, forces, Step.Scale, trajectories);
        SleepWaker waker = parts.SleepWaker(Bodies, Timelines, view, graph, rewinds, members);
        IslandSleep sleep = new(Bodies, Timelines, graph, Step);
        IslandStatics statics = parts.IslandStatics(Bodies, forces, graph, Step);
        StepForces stepForces = new(Bodies, Timelines, forces, graph, Step);
        StepSegments stepSegments = new(scene, Bodies, Timelines, graph, Step, stepForces, members, trajectories, sleep);
        Stepper = new IslandStepper(
            Bodies, Timelines, graph, Step, stepForces, partners, rewinds, members, stepSegments, sleep, statics, marks, work);

        // The handlers of events.
        CollapseRule collapse = parts.CollapseRule(scene, Bodies, Timelines, graph, strikes);
        CaptureRule capture = new(scene, Timelines, graph, Step.Scale, members, trajectories.Friction, hasIslands);
        FreeImpactResponse resolver = new(scene, Bodies, Timelines, graph, Step.Scale, capture, collapse);
        ClosedInstants closed = new(Progress, graph);
        ImpactNotifier notifier = new(Bodies, Timelines, graph);
        HandBlows blows = new(Bodies, Timelines, graph, capture, Step.Rules);
        ImpactSegments segments = new(Timelines, graph, trajectories, blows);
        SegmentLinker linker = parts.SegmentLinker(Bodies, Timelines, graph, partners, members);
        Isolated = parts.IsolatedImpact(
            scene, Bodies, Timelines, scheduler, rollback, flights, graph, resolver, notifier, segments);
        ImpactGraphBuilder builder = parts.ImpactGraphBuilder(
            scene, Bodies, Timelines, rollback, rewinds, view, flights, BroadPhase, collisions, collapse, graph, partners, work);
        IslandImpactProblem problem = new(Step, work);
        IslandImpactSegments memberSegments = new(
            Bodies, Timelines, graph, problem, members, memberContacts, trajectories, resolver, segments, closed);
        IslandImpact island = new(
            scene, Bodies, Timelines, rewinds, graph, Step.Scale, problem, partners, memberContacts, trajectories.Friction, notifier,
            memberSegments, blows);
        ImpactCrowd crowd = new(graph, Step.Rules);
        ImpactHandler impacts = new(graph, partners, Isolated, builder, crowd, resolver, island, notifier, segments, linker, closed);
        StepEndHandler steps = new(Timelines, graph, Stepper, trajectories, linker);
        ForwardedPath lonePath = new(scene, Bodies, Timelines, new SingleBodyWorld(scene, start, options.MaxSegments));
        FilterChange filters = new(scene, Bodies, Timelines, members, trajectories);
        ExternalHandler externals = new(
            scene, Bodies, Timelines, log, flights, graph, waker, members, trajectories, collapse, lonePath, filters,
            parts.FreePlaces(scene, Bodies, Timelines, view));
        LossHandler losses = new(Bodies, Timelines, waker);
        EventDispatcher dispatcher = new(Progress, graph, predictor, impacts, steps, externals, crossingHandler, losses, marks, rewinds, Rewinder);
        Meter = new WorkMeter(Bodies, graph, work, rollback);

        // What comes from outside, and what rules do.
        Roster = new BodyRoster(
            scene, Bodies, Timelines, log, scheduler, Progress, rollback, flights, BroadPhase, trajectories, collapse)
        {
            Crossings = Crossings,
        };
        BroadPhaseGrowth growth = new(Bodies, Progress, rollback, BroadPhase, predictor);
        if (Rules is not null)
        {
            RuleView ruleView = new(scene, Bodies, Timelines, Crossings);
            RuleWorld ruleWorld = new(scene, (GameRules)scene.Rules!, ruleMemory!, ruleView, start, options.RunningRuleCall);
            RuleActs acts = new(Roster, Bodies, log, growth, predictor, Rewinder);
            Caller = parts.RuleCaller((GameRules)scene.Rules!, Rules, ruleMemory!, ruleWorld, ruleView, acts, options.Healing);
        }

        agenda = new Agenda(scheduler, Rules);
        Loop = new EventLoop(
            Progress, Timelines, agenda, rollback, Rewinder, dispatcher, BroadPhase, Meter, trajectories.Failures, Caller,
            options.Cancellation);
        Intake = new EventIntake(Roster, Bodies, log, Progress, growth, predictor, Rewinder, Loop, Rules);
    }

    internal Scene Scene { get; }

    internal Progress Progress { get; }

    internal BodyTable Bodies { get; }

    internal TimelineStore Timelines { get; }

    internal StateReader Reader { get; }

    /// <summary>The crossings of sensors; null in a scene without.</summary>
    internal CrossingLog? Crossings { get; }

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

    /// <summary>Reads which bodies have left the world by themselves.</summary>
    internal LossReader Losses { get; }

    /// <summary>The calls of the scene's rules, and their state; null where it has none.</summary>
    internal RuleLog? Rules { get; }

    /// <summary>Makes the calls of rules; null where there are none.</summary>
    internal RuleCaller? Caller { get; }

    /// <summary>How far a rollback has come, and what rollbacks have done so far.</summary>
    internal RollbackState Rollback => rollback;

    /// <summary>The last instant that can be read: nothing happens between what is simulated and here.</summary>
    internal SimTime Horizon
    {
        get
        {
            SimTime next = agenda.NextTime;
            return next == SimTime.MaxValue ? next : SimTime.Max(Progress.SimulatedTo, next - SimDuration.OneTick);
        }
    }

    /// <summary>All bodies that are there at first have been added: what they meet is predicted.</summary>
    internal void Begin()
    {
        Timelines.Triggers = Rules; // not before: what a snapshot has was heard of
        Timelines.Losses = lossObserver;
        if (Crossings is not null)
        {
            Crossings.Triggers = Rules;
        }

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
        Rules?.DropBefore(Progress.HistoryEdge);
    }
}
