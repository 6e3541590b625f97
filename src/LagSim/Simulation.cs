using System;
using System.Threading;
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

namespace LagSim;

/// <summary>The face of the world: advance it to a time, submit what players do, read any instant in the window, hash it.</summary>
/// <remarks>
/// <para>Its state is a pure function of the scene and the external events submitted, whatever the order in which they came:
/// <c>state(t) = Fold(scene, events up to t, in canonical order)</c>, bit for bit.</para>
/// <para>Not thread-safe: one thread at a time. <c>LagSim.Hosting</c> gives it a thread of its own. No allocation per event once as many
/// segments were alive as will be.</para>
/// <para>An exception out of <see cref="AdvanceTo"/> or <see cref="Submit"/> other than an argument's leaves it faulted: every later call
/// throws. One that was cancelled still stands from <see cref="HistoryEdge"/> to <see cref="SimulatedTo"/>, if that is not before it.</para>
/// </remarks>
public sealed partial class Simulation : IOpeningObserver
{
    private readonly TimelineStore timelines;
    private readonly Paths paths;
    private readonly EventLog log;
    private readonly EventScheduler scheduler;
    private readonly Forces forces;
    private readonly FreeFlights flights;
    private readonly StaticSurfaces surfaces;
    private readonly SimDuration history;
    private readonly CancellationToken cancellation;
    private readonly HealingMode healing;
    private readonly BodyTable bodies;
    private readonly TrajectoryFactory trajectories;
    private readonly RollbackState rollback = new();
    private readonly PathView view;
    private readonly TestFaults faults = new();
    private readonly MemberContacts memberContacts;
    private readonly StrikeCounts strikes;
    private readonly CollisionPredictor predictor;
    private readonly CollapseRule collapseRule;
    private readonly CaptureRule capture;
    private readonly ImpactResolver resolver;
    private readonly StepMarks stepMarks = new();
    private readonly ContactGraph graph;
    private readonly CollisionSearch search;
    private Exception? fault;

    /// <summary>Which fold this library computes, from 1 on: builds of one version give one scene and events the same states and hashes, to the bit.</summary>
    /// <remarks>
    /// <para>It is raised by one whenever a pinned hash or one of the corpus moves; a test holds it to that. It says nothing of layouts, which the versions of wire and
    /// recordings count, nor of a program's own forces, which have their author's.</para>
    /// <para>Peers of other versions would each compute a world of its own, and a recording of another version gives other hashes than stand in it.</para>
    /// <para>Not a <see langword="const"/>: that would be copied into whatever is built against the library, and tell of another build than the one that runs.</para>
    /// </remarks>
    public static int FoldVersion => 10;

    /// <summary>A world at the start of its scene, with all that happens at that instant. Cost: the bodies, and which of them can meet.</summary>
    /// <param name="scene">What is simulated.</param>
    /// <param name="options">How; null for the defaults.</param>
    /// <exception cref="ArgumentNullException">There is no scene.</exception>
    /// <exception cref="SimulationException">
    /// The scene's forces are too much for the first step of a body, or what happens at the first instant for the timelines.
    /// </exception>
    /// <exception cref="OperationCanceledException">The options' token asked for an end.</exception>
    public Simulation(Scene scene, SimulationOptions? options = null)
        : this(scene ?? throw new ArgumentNullException(nameof(scene)), options ??= new SimulationOptions(), options.Start, options.Start,
              scene.BodyArray.Length)
    {
        for (int i = 0; i < scene.BodyArray.Length; i++)
        {
            Begin(i);
        }

        PredictAll();
        AdvanceTo(Start);
        twin = healing == HealingMode.SyncTest ? new Simulation(scene, options.FullyRolledBack()) : null;
    }

    /// <summary>
    /// A scene's bodies on the first pieces of their flights, of which none meets anything: only to be read, where a world of the scene cannot begin.
    /// </summary>
    /// <param name="scene">The scene.</param>
    /// <param name="obstacles">Of each body why it cannot take a step; null where it can.</param>
    internal static Simulation OfFlightsAlone(Scene scene, string?[] obstacles)
    {
        SimulationOptions options = new();
        Simulation flights = new(scene, options, options.Start, options.Start, scene.BodyArray.Length);
        for (int i = 0; i < scene.BodyArray.Length; i++)
        {
            try
            {
                flights.Begin(i);
            }
            catch (SimulationException failure)
            {
                obstacles[i] = failure.Message;
            }
        }

        return flights;
    }

    /// <summary>A world without bodies, with room for as many as are expected; what none of them may need is made when one does.</summary>
    private Simulation(Scene scene, SimulationOptions options, SimTime start, SimTime from, int expected)
    {
        Scene = scene;
        Start = start;
        history = options.History;
        cancellation = options.Cancellation;
        Threads = options.Threads;
        healing = options.Healing;
        mostPairs = options.MostPairs;
        rollback.Cursor = EventKey.Before(from);
        SimulatedTo = from - SimDuration.OneTick;
        HistoryEdge = from;
        bodies = new BodyTable(expected);
        scheduler = new EventScheduler(expected);
        log = new EventLog(expected);
        flights = new FreeFlights(scene.Gravity, scene.Resolution, scene.Box, expected, 0.5 * scene.ContactTolerance);
        timelines = new TimelineStore(start, options.MaxSegments, flights, expected, history);
        paths = new Paths(timelines);
        view = new PathView(timelines, rollback, faults);
        Observer = options.Observer;
        timelines.ForgetBefore(from);
        forces = new Forces(scene, start);
        trajectories = new TrajectoryFactory(scene, forces, bodies, timelines);
        surfaces = scene.Surfaces;
        step = new ContactStep(scene, options.Scale ?? new ContactScale(scene.ContactTolerance, scene.Gravity, start));
        graph = new ContactGraph(bodies, timelines, surfaces, scene.Box);
        partners = new Partners(bodies, timelines, view);
        members = new MemberFactory(bodies, timelines, forces, step.Scale, trajectories);
        sleepers = new Sleepers(bodies, timelines, view, graph, partners, members);
        stepper = new IslandStepper(scene, bodies, timelines, forces, graph, step, partners, members, trajectories, stepMarks, work);
        memberContacts = new MemberContacts(timelines, view, bodies, surfaces, step.Scale);
        strikes = new StrikeCounts(timelines, bodies, surfaces, scene.Box);
        collapseRule = new CollapseRule(scene, bodies, timelines, graph, strikes, faults);
        capture = new CaptureRule(scene, timelines, graph, step.Scale, members, trajectories.Friction, faults);
        resolver = new ImpactResolver(scene, bodies, timelines, graph, capture, collapseRule);
        predictor = new CollisionPredictor(scene, start, bodies, timelines, rollback, view, memberContacts, strikes, step.Scale, faults);
        search = new CollisionSearch(bodies, timelines, flights, surfaces, predictor, stepMarks, faults);
    }

    /// <summary>How many threads at most may be at work for it.</summary>
    internal int Threads { get; }

    /// <summary>What was there at the start.</summary>
    public Scene Scene { get; }

    /// <summary>The instant at which the scene began.</summary>
    public SimTime Start { get; }

    /// <summary>The instant up to which, and including which, everything has happened.</summary>
    public SimTime SimulatedTo { get; private set; }

    /// <summary>The earliest instant that can be read or changed.</summary>
    public SimTime HistoryEdge { get; private set; }

    /// <summary>The last instant that can be read: nothing happens between <see cref="SimulatedTo"/> and here.</summary>
    public SimTime Horizon => scheduler.Count == 0 ? SimTime.MaxValue : SimTime.Max(SimulatedTo, scheduler.LeastKey.Time - SimDuration.OneTick);

    /// <summary>How many bodies are known, absent ones included. One that is gone for good is forgotten when room is needed.</summary>
    public int BodyCount => bodies.Count;

    /// <summary>How many events were processed, those that were simulated again included.</summary>
    public long EventsProcessed { get; private set; }

    /// <summary>How many impacts were among them; what bodies do to each other at one tick and round is one.</summary>
    public long ImpactsProcessed { get; private set; }

    /// <summary>How often timelines were cut for an event that came late or was taken back.</summary>
    public long Rollbacks { get; private set; }

    /// <summary>How many segments were cut off by rollbacks, to be simulated again.</summary>
    public long SegmentsCut { get; private set; }

    /// <summary>The identity of the n-th body in canonical order, 0 &lt;= n &lt; <see cref="BodyCount"/>. Later spawns may shift n.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no n-th.</exception>
    public BodyId BodyAt(int n) => bodies.Id(bodies.SlotAt(n));

    /// <summary>Adds a body of the scene, on the first piece of its flight.</summary>
    private void Begin(int n)
    {
        ref readonly SceneBody body = ref Scene.BodyArray[n];
        int slot = AddBody(BodyId.OfScene(n), body.Spec);
        collapseRule.HasLosses |= body.Spec.Restitution < 1;
        EventKey key = new(Start, 0, EventKind.Start, bodies.Id(slot), bodies.Id(slot), 0, 0);
        trajectories.Flights.Open(slot, key, body.Position, body.Velocity, spin: body.Spin);
    }

    private void PredictAll()
    {
        index = bodies.Count > mostPairs ? NewIndex() : index;
        for (int slot = 0; slot < bodies.SlotCount; slot++)
        {
            cancellation.ThrowIfCancellationRequested();
            Predict(slot);
        }
    }

    private int AddBody(BodyId id, BodySpec spec = default)
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
        return slot;
    }

    /// <summary>Forgets the timeline of a body that is not there and that nothing inside the window says anything of; false for any other.</summary>
    private bool ForgetIfAbsent(int slot)
    {
        log.DropBefore(slot, HistoryEdge);
        timelines.DropBefore(slot, HistoryEdge);
        int last = timelines.Last(slot);
        bool isGone = log.IsEmpty(slot) && !timelines.Segment(last).IsPresent && timelines.Key(last).Time < HistoryEdge;
        if (isGone)
        {
            timelines.Forget(slot);
            index.Forget(slot);
        }

        return isGone;
    }

    private void ThrowIfFaulted()
    {
        if (fault is not null)
        {
            throw new InvalidOperationException("The simulation has faulted and cannot go on; see the inner exception.", fault);
        }
    }
}
