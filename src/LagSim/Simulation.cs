using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>A deterministic world that can be advanced, changed and read at any time in its window.</summary>
/// <remarks>
/// <para>Its state is a pure function of the scene and the submitted external events, in whatever order they came: <c>state(t) =
/// Fold(scene, events up to t, in canonical order)</c>, bit for bit.</para>
/// <para>Not thread-safe: one thread at a time. <c>LagSim.Hosting</c> gives it a thread of its own. No allocation per event once the number
/// of live segments has reached its maximum.</para>
/// <para>An exception from <see cref="AdvanceTo"/>, except for a wrong argument, leaves it faulted: every later call throws. A cancelled
/// world can still be read from <see cref="HistoryEdge"/> to <see cref="SimulatedTo"/>, if that is not before it.</para>
/// </remarks>
/// <example>
/// A late event changes the past, and everything that depends on it is simulated again:
/// <code>
/// Simulation world = new(scene);
/// world.AdvanceTo(SimTime.FromSeconds(2));
/// ExternalEvent kick = PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)).Stamp(SimTime.FromSeconds(1.5), peer: 1, sequence: 1);
/// world.Submit(kick);
/// world.AdvanceTo(SimTime.FromSeconds(2)); // as if the kick had come in time, to the last bit
/// if (world.TryRead(ball, SimTime.FromSeconds(2), out BodyState state))
/// {
///     Console.WriteLine($"{state.Position} {world.StateHash(SimTime.FromSeconds(2)):x16}");
/// }
/// </code>
/// </example>
public sealed class Simulation
{
    private readonly SyncTest? syncTest;

    /// <summary>Creates a world at the start of its scene and processes the events of that instant. Cost: grows with the bodies, and with
    /// the pairs of them that can meet.</summary>
    /// <param name="scene">The scene to simulate.</param>
    /// <param name="options">The options; null for the defaults.</param>
    /// <exception cref="ArgumentNullException">The scene is null.</exception>
    /// <exception cref="SimulationException">The scene's forces are too strong for the first step of a body, or the first instant needs
    /// more segments than the timelines may hold.</exception>
    /// <exception cref="OperationCanceledException">The options' token was cancelled.</exception>
    public Simulation(Scene scene, SimulationOptions? options = null)
        : this(Begun(scene ?? throw new ArgumentNullException(nameof(scene)), options ??= new SimulationOptions()), options.Start)
    {
        syncTest = options.Healing == HealingMode.SyncTest ? new SyncTest(Engine, new Simulation(scene, options.FullyRolledBack())) : null;
    }

    /// <summary>Continues from a snapshot of a world of this scene: the same events give the same bits as in the world it was taken
    /// from.</summary>
    /// <param name="scene">The scene of the snapshot's world. What the snapshot tells of its bodies is checked against it. Walls are not in
    /// a snapshot, so one of a scene that differs in them alone is accepted; sessions compare <see cref="Scene.Hash"/>.</param>
    /// <param name="snapshot">The snapshot to continue from. Earlier events are in it; they are <see cref="SubmitResult.TooOld"/>.</param>
    /// <param name="options">As for a new world, except <see cref="SimulationOptions.Start"/>, which comes from the snapshot.</param>
    /// <exception cref="ArgumentNullException">The scene or the snapshot is missing.</exception>
    /// <exception cref="SceneException">The snapshot holds a value that no world of this scene can have; the message names it.</exception>
    /// <exception cref="SimulationException">It cannot be simulated.</exception>
    public Simulation(Scene scene, WorldSnapshot snapshot, SimulationOptions? options = null)
        : this(Begun(scene, snapshot, options ??= new SimulationOptions()), snapshot.Time)
    {
        syncTest = options.Healing == HealingMode.SyncTest ? new SyncTest(Engine, new Simulation(scene, snapshot, options.FullyRolledBack())) : null;
    }

    private Simulation(Engine engine, SimTime from)
    {
        Engine = engine;
        AdvanceTo(from);
    }

    /// <summary>The version of the fold that this library computes, from 1 on: builds of one version give the same scene and events the
    /// same states and hashes, to the bit.</summary>
    /// <remarks>
    /// <para>It is raised by one whenever a pinned hash or one of the corpus moves; a test holds it to that. It does not cover layouts,
    /// which have the versions of wire and recordings, nor a program's own forces, which have their author's version.</para>
    /// <para>Peers of other versions would each compute a world of its own, and a recording of another version gives other hashes than
    /// those stored in it.</para>
    /// <para>Not a <see langword="const"/>: that would be copied into assemblies built against the library, and could name another build
    /// than the one that runs.</para>
    /// </remarks>
    public static int FoldVersion => 16;

    /// <summary>The scene at the start.</summary>
    public Scene Scene => Engine.Scene;

    /// <summary>The instant at which the scene began.</summary>
    public SimTime Start => Engine.Progress.Start;

    /// <summary>
    /// The instant up to which, and including which, everything has happened. A submitted late event rewinds it to before its own time.
    /// </summary>
    public SimTime SimulatedTo => Engine.Progress.SimulatedTo;

    /// <summary>The earliest instant that can be read or changed.</summary>
    public SimTime HistoryEdge => Engine.Progress.HistoryEdge;

    /// <summary>The last instant that can be read: nothing happens between <see cref="SimulatedTo"/> and here.</summary>
    public SimTime Horizon => Engine.Horizon;

    /// <summary>How many bodies are known, absent ones included. One that is gone for good is forgotten when room is needed.</summary>
    public int BodyCount => Engine.Bodies.Count;

    /// <summary>How many events were processed, those that were simulated again included.</summary>
    public long EventsProcessed => Engine.Progress.EventsProcessed;

    /// <summary>The number of impacts among them. Bodies that touch at one tick and round take part in one impact.</summary>
    public long ImpactsProcessed => Engine.Progress.ImpactsProcessed;

    /// <summary>
    /// The number of impacts among them by which an instant was closed that had gone on for 1024 rounds, as where elastic balls are packed
    /// without room: what touches was solved together, so that it closed no more. In most worlds none ever is.
    /// </summary>
    public long ImpactsClosed => Engine.Progress.ImpactsClosed;

    /// <summary>
    /// The kinetic energy that was lost in <see cref="ImpactsClosed"/>, in J, 0 or more apart from rounding: what bodies had that nothing
    /// lets move, and what their restitution takes. Impacts that were simulated again count again.
    /// </summary>
    public double EnergyLostInClosing => Engine.Progress.EnergyLostInClosing;

    /// <summary>The number of times that timelines were cut for a late or a retracted event.</summary>
    public long Rollbacks => Engine.Rollback.Count;

    /// <summary>How many segments were cut off by rollbacks, to be simulated again.</summary>
    public long SegmentsCut => Engine.Rollback.SegmentsCut;

    /// <summary>Its parts.</summary>
    internal Engine Engine { get; }

    /// <summary>Whether an advance may stop within an instant (<see cref="EventLoop.WaitsForLateEvents"/>). A sync test's twin has no way
    /// to stop where this world does, so there it never may.</summary>
    internal bool WaitsForLateEvents
    {
        get => Engine.Loop.WaitsForLateEvents;
        set => Engine.Loop.WaitsForLateEvents = value && syncTest is null;
    }

    /// <summary>Raised on the thread that advances, once per heal, when the world is again where it was. Handlers must not throw, and not
    /// change the world.</summary>
    public event Action<HealReport>? Healed
    {
        add => Engine.Rewinder.Healed += value;
        remove => Engine.Rewinder.Healed -= value;
    }

    /// <summary>Lets everything happen up to and including <paramref name="time"/>; what late events have changed is simulated
    /// again.</summary>
    /// <remarks>Reading, and advancing in smaller or larger steps, changes no bit of what happens. Cost: per event, not per time.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="SimulatedTo"/>, or more than 84 days after the
    /// origin.</exception>
    /// <exception cref="SimulationException">A body left the range in which its state means something, or the timelines their
    /// memory.</exception>
    /// <exception cref="OperationCanceledException">The options' token was cancelled; everything before <see cref="SimulatedTo"/>
    /// stays.</exception>
    public void AdvanceTo(SimTime time)
    {
        long events = long.MaxValue;
        TryAdvanceTo(time, ref events);
        Engine.Loop.ThrowIfBlockedAt(time);
    }

    /// <summary>Advances the world up to and including <paramref name="time"/>, or by a number of events, and stops between two instants.
    /// The world of a session (<see cref="Hosting.LiveWorld.WaitsForLateEvents"/>) stops within one too, if it takes too long.</summary>
    /// <param name="time">Up to when.</param>
    /// <param name="events">The number of events that may happen; on return, what is left of it. The events of one instant all happen, so
    /// it may end below zero. At or below zero nothing happens. Predicting a body's next event again counts as an event.</param>
    /// <returns>Whether it got there; if not, <see cref="SimulatedTo"/> is how far it got, and the next call continues from there. A world
    /// that an instant blocks (<see cref="Hosting.LiveWorld.BlockedAt"/>) gets no further, whatever is left, until an event comes
    /// that is no later.</returns>
    /// <remarks>Advancing in pieces changes no bit of what happens. Cost: per event, not per time.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="SimulatedTo"/>, or more than 84 days after the
    /// origin.</exception>
    /// <exception cref="SimulationException">A body left the range in which its state means something, or the timelines their
    /// memory.</exception>
    /// <exception cref="OperationCanceledException">The options' token was cancelled; everything before <see cref="SimulatedTo"/>
    /// stays.</exception>
    public bool TryAdvanceTo(SimTime time, ref long events)
    {
        Engine.Loop.ThrowIfFaulted();
        if (time < SimulatedTo)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"The world is simulated to {SimulatedTo.ToShortString()} already; it advances, and an event that lies"
                    + " before rolls it back.");
        }

        if (time > Limits.LatestTime)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"A world lasts until {Limits.LatestTime.ToShortString()} (84 days) at most.");
        }

        bool isThere = Engine.Loop.TryAdvanceTo(time, ref events);
        syncTest?.Follow();
        return isThere;
    }

    /// <summary>Adds an event at its own time. If that time is simulated already, the paths that it can have touched are undone from there
    /// on (<see cref="SimulationOptions.Healing"/> decides which). <see cref="SimulatedTo"/> then lies before it, the next
    /// <see cref="AdvanceTo"/> simulates them again, and <see cref="Healed"/> reports what that took.</summary>
    /// <returns>The result. <see cref="SubmitResult.TooOld"/> means that nothing changed.</returns>
    /// <remarks>A submitted event need not have an effect: that depends on what it meets when its time comes; see <see cref="TookEffect"/>.
    /// Cost of an event that lies ahead: the same for any number of bodies, unless it is a spawn for which the broad phase has to be
    /// rebuilt. A late event cuts the segments since its time of the bodies that it can have touched, or of all bodies with a full rollback, and
    /// predicts their next events. The next advance simulates them again.</remarks>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    public SubmitResult Submit(in ExternalEvent external)
    {
        Check(external);
        syncTest?.Submit(external);
        return Engine.Intake.Insert(external, external.Key, isForwarded: false);
    }

    /// <summary>Adds an event that takes effect at <paramref name="arrival"/>, after its own time, by advancing the body alone from the
    /// event's time to the arrival: its own motion and contacts with static geometry, as the thesis does. Nothing before the arrival is
    /// rewritten. A hand's actions (grab, keyframe, release) are applied at the arrival as they are.</summary>
    /// <returns>The result.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The arrival is before the event's time, or more than 84 days after the origin.</exception>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    public SubmitResult SubmitForwarded(in ExternalEvent external, SimTime arrival)
    {
        if (arrival < external.Time)
        {
            throw new ArgumentOutOfRangeException(nameof(arrival), arrival.ToShortString(), $"An event of {external.Time.ToShortString()} cannot arrive before"
                + " it happened.");
        }

        if (arrival > Limits.LatestTime)
        {
            throw new ArgumentOutOfRangeException(
                nameof(arrival), arrival.ToShortString(), $"A world lasts until {Limits.LatestTime.ToShortString()} (84 days) at most.");
        }

        Check(external);
        syncTest?.SubmitForwarded(external, arrival);
        return external.Time < HistoryEdge
            ? SubmitResult.TooOld
            : Engine.Intake.Insert(external, external.At(arrival).Key, isForwarded: true);
    }

    /// <summary>
    /// Retracts an event, as if it had never been; false if it is not there (any more). The next advance simulates again what it had
    /// touched.
    /// </summary>
    public bool Retract(in ExternalEvent external)
    {
        Engine.Loop.ThrowIfFaulted();
        syncTest?.Retract(external);
        return Engine.Intake.Retract(external);
    }

    /// <summary>The identity of the n-th body in canonical order, 0 &lt;= n &lt; <see cref="BodyCount"/>. Later spawns may shift
    /// n.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no n-th.</exception>
    public BodyId BodyAt(int n) => n >= 0 && n < BodyCount ? Engine.Bodies.Id(Engine.Bodies.SlotAt(n))
        : throw new ArgumentOutOfRangeException(nameof(n), n, $"The world has {Limits.Count(BodyCount, "body", "bodies")}, counted from 0.");

    /// <summary>Where a body is at any instant from <see cref="HistoryEdge"/> to <see cref="Horizon"/>, after all events of that
    /// tick.</summary>
    /// <returns>False, and a state that is <see cref="MotionLaw.Absent"/>, if the body is unknown or not there at that time.</returns>
    /// <remarks>Opens no segment and changes nothing. Cost: the number of the body's segments after that time. A time that is not simulated
    /// is an error of the caller, which advances this world itself, and so an exception. A <see cref="Hosting.RenderSnapshot"/>, which
    /// another thread makes, returns false there.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="HistoryEdge"/> or after <see cref="Horizon"/>: advance
    /// first.</exception>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception.</exception>
    public bool TryRead(BodyId body, SimTime time, out BodyState state)
    {
        CheckReadable(time);
        state = Engine.Reader.StateAt(Engine.Bodies.SlotOf(body), time);
        return state.Motion != MotionLaw.Absent;
    }

    /// <summary>The hold on a body at an instant that can be read: which peer holds it, by which point, and the time of the hand's last
    /// keyframe.</summary>
    /// <returns>False, and the default, if no peer holds it.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public bool TryReadHold(BodyId body, SimTime time, out Hold hold)
    {
        CheckReadable(time);
        return Engine.Reader.TryReadHold(Engine.Bodies.SlotOf(body), time, out hold);
    }

    /// <summary>The world's state of the rules at an instant that can be read.</summary>
    /// <typeparam name="T">The type that the scene's rules declare.</typeparam>
    /// <returns>False, and the default, if the scene has no rules.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    /// <exception cref="InvalidOperationException">The rules declare another type, or none; or the simulation ended by an exception.</exception>
    public bool TryReadRules<T>(SimTime time, out T state)
        where T : unmanaged
    {
        RuleStateReader.CheckWorld<T>(Scene);
        CheckReadable(time);
        state = Engine.Rules is null ? default : RuleStateReader.Read<T>(Scene, Engine.Rules.StateAt(time).Bytes);
        return Engine.Rules is not null;
    }

    /// <summary>A body's state of the rules at an instant that can be read.</summary>
    /// <typeparam name="T">The type that the scene's rules declare for bodies.</typeparam>
    /// <returns>False, and the default, if the body has none, or the scene has no rules.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    /// <exception cref="InvalidOperationException">The rules declare another type, or none; or the simulation ended by an exception.</exception>
    public bool TryReadRules<T>(BodyId body, SimTime time, out T state)
        where T : unmanaged
    {
        RuleStateReader.CheckBody<T>(Scene);
        CheckReadable(time);
        state = default;
        return Engine.Rules is not null && RuleStateReader.TryRead(Scene, Engine.Rules.StateAt(time).Bytes, body, out state);
    }

    /// <summary>Whether a body is inside of a sensor at an instant that can be read, after all events of that tick.</summary>
    /// <param name="body">The body. An unknown one, or one that is not there, is inside of none.</param>
    /// <param name="sensor">The index of the sensor in <see cref="Scene.Sensors"/>; <see cref="Scene.SensorNamed"/> finds it.</param>
    /// <param name="time">From <see cref="HistoryEdge"/> to <see cref="Horizon"/>.</param>
    /// <remarks>Pure, the same on every peer. Cost: the number of the body's crossings after that time.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window, or the scene has no such sensor.</exception>
    public bool IsInside(BodyId body, int sensor, SimTime time)
    {
        CheckReadable(time);
        if (sensor < 0 || sensor >= Scene.SensorArray.Length)
        {
            throw new ArgumentOutOfRangeException(
                nameof(sensor), sensor, $"Scene '{Scene.Name}' has {Limits.Count(Scene.SensorArray.Length, "sensor")}, counted from 0.");
        }

        return Engine.Reader.IsInside(Engine.Bodies.SlotOf(body), sensor, time);
    }

    /// <summary>The crossings of sensors from one instant to another, both included, in canonical order.</summary>
    /// <param name="from">What lies before <see cref="HistoryEdge"/> is no longer kept, and left out.</param>
    /// <param name="to">What lies after <see cref="SimulatedTo"/> is not known yet, and left out.</param>
    /// <remarks>A late event may change the answer, as it may change every state in the window. Allocates. Cost: grows with the bodies, and
    /// with the crossings since <paramref name="from"/>.</remarks>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception.</exception>
    public IReadOnlyList<Crossing> Crossings(SimTime from, SimTime to)
    {
        Engine.Loop.ThrowIfFaulted();
        return Engine.Reader.CrossingsIn(SimTime.Max(from, HistoryEdge), SimTime.Min(to, SimulatedTo));
    }

    /// <summary>The bodies that have left the world by themselves, because their motion cannot be followed further, as far as they are still
    /// kept: for as long as the history, and longer while no other body takes their room.</summary>
    /// <returns>In canonical order of bodies.</returns>
    /// <remarks>What a body does never ends a world: one that becomes too fast, or whose forces no step follows, is taken out of it, on every
    /// peer alike; rules hear of it by <see cref="GameRules.OnLost"/>, a game by <see cref="Hosting.LossNotices"/>. A late event may bring it
    /// back. Allocates. Cost: grows with the bodies.</remarks>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception.</exception>
    public IReadOnlyList<LostBody> LostBodies()
    {
        Engine.Loop.ThrowIfFaulted();
        return Engine.Losses.Read();
    }

    /// <summary>A hash of the exact bits and identities of every body that is there at <paramref name="time"/>, and of the sensors that it is
    /// inside of, and of the state of the rules.</summary>
    /// <remarks>Equal on two peers if and, to 64 bits, only if their worlds are the same then. It does not depend on the time of
    /// day.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public ulong StateHash(SimTime time)
    {
        CheckReadable(time);
        return Engine.Reader.StateHash(time);
    }

    /// <summary>A hash of every event from the start up to and including <paramref name="time"/>, in canonical order, with what came of
    /// it.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public ulong EventHash(SimTime time)
    {
        CheckReadable(time);
        return Engine.Reader.EventHash(time);
    }

    /// <summary>A body's events that are kept, in order, each with the state right after it. Empty for an unknown body.</summary>
    /// <remarks>For reports and tests; allocates. Cost: the number of the body's segments.</remarks>
    public IReadOnlyList<TimelineEntry> Timeline(BodyId body) => Timeline(body, SimTime.MinValue);

    /// <summary>The kept events of a body: the last one up to and including <paramref name="from"/>, which began the motion that it is in
    /// then, and all after it.</summary>
    /// <param name="body">The body. An unknown one has no events.</param>
    /// <param name="from">The start, in simulated time; any instant, also one that is no longer kept or not simulated yet.</param>
    /// <returns>In order, each with the state right after it.</returns>
    /// <remarks>For reports during the simulation; allocates. Cost: the number of the events returned, however long the history
    /// is.</remarks>
    public IReadOnlyList<TimelineEntry> Timeline(BodyId body, SimTime from) => Engine.Reader.Timeline(Engine.Bodies.SlotOf(body), from);

    /// <summary>Whether an event changed its body, as far as is known now. False while its time is not simulated yet; if it was submitted
    /// and its time has come, it had no effect: the body was not there, or was held (or not held by that hand), or the peer may not
    /// touch it, or there was no room (<see cref="WhenOccupied"/>), or an impulse would have made it faster than a player may make a body, a
    /// tenth of <see cref="Scene.SmallestRadius"/> in a tick. Nothing is ever clamped. A late event may change the answer. Events are told
    /// apart by tick, kind, body, peer and number: two that share all of these have one answer, so give every event a number of its
    /// own.</summary>
    /// <remarks>Pure, the same on every peer. Cost: the number of the body's segments. Before <see cref="HistoryEdge"/> the answer is no
    /// longer known: false.</remarks>
    public bool TookEffect(in ExternalEvent external) => Engine.Reader.TookEffect(external);

    /// <summary>The tag of a body that has been there, 64 bits of the game's own; 0 for an unknown one.</summary>
    public ulong TagOf(BodyId body) => SpecOf(body).Tag;

    /// <summary>The properties of a body that has been there; the default for an unknown one.</summary>
    public BodySpec SpecOf(BodyId body)
    {
        int slot = Engine.Bodies.SlotOf(body);
        return slot < 0 ? default : Engine.Bodies.Spec(slot);
    }

    /// <summary>Which peers may do something to a spawned body, as its spawn said, once that has happened; everyone for any other.</summary>
    public PeerSet PlayersOf(BodyId body)
    {
        int slot = Engine.Bodies.SlotOf(body);
        return slot < 0 ? default : Engine.Bodies.Players(slot);
    }

    /// <summary>The world after everything before <paramref name="time"/>. Changes nothing. Cost: the segments of all bodies since
    /// then.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside <see cref="HistoryEdge"/> to <see cref="SimulatedTo"/>, or not
    /// after the start.</exception>
    public WorldSnapshot Snapshot(SimTime time)
    {
        Engine.Loop.ThrowIfFaulted();
        if (time < HistoryEdge || time > SimulatedTo || time <= Start)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time),
                time.ToShortString(),
                SimulatedTo <= Start ? $"A snapshot is of an instant after the start, {Start.ToShortString()}, and nothing is simulated yet: advance the world first."
                    : $"A snapshot can be taken from {SimTime.Max(HistoryEdge, Start + SimDuration.OneTick).ToShortString()} to"
                        + $" {SimulatedTo.ToShortString()}, up to where the world is simulated.");
        }

        return Engine.Reader.Snapshot(time);
    }

    /// <summary>Forgets what lies before <paramref name="time"/>: nothing there can be read or changed any more. Earlier than now is kept,
    /// later is not forgotten.</summary>
    public void DropHistoryBefore(SimTime time)
    {
        Engine.DropHistoryBefore(time);
        syncTest?.DropHistoryBefore(time);
    }

    private static Engine Begun(Scene scene, SimulationOptions options)
    {
        Engine engine = new(scene, options, options.Start, options.Start, scene.BodyArray.Length);
        for (int i = 0; i < scene.BodyArray.Length; i++)
        {
            engine.Roster.AddFromScene(i);
        }

        BodyId last = BodyId.FromPacked(ulong.MaxValue); // after the start of every body
        engine.Rules?.Add(new EventKey(options.Start, 0, EventKind.Start, last, last, 0, 0), default);
        engine.Begin();
        return engine;
    }

    private static Engine Begun(Scene scene, WorldSnapshot snapshot, SimulationOptions options)
    {
        _ = scene ?? throw new ArgumentNullException(nameof(scene));
        SnapshotCheck.Throw(snapshot ?? throw new ArgumentNullException(nameof(snapshot)), scene);
        Engine engine = new(scene, options, snapshot.Start, snapshot.Time, snapshot.BodyArray.Length, snapshot.RuleStateArray);
        foreach (ref readonly BodySnapshot body in snapshot.BodyArray.AsSpan())
        {
            engine.Roster.AddFromSnapshot(body);
        }

        engine.Timelines.ContinueFrom(snapshot.EventHash);
        engine.Begin();
        return engine;
    }

    private void Check(in ExternalEvent external)
    {
        Engine.Loop.ThrowIfFaulted();
        ExternalEventCheck.Throw(external, Scene);
    }

    private void CheckReadable(SimTime time)
    {
        Engine.Loop.ThrowIfFaulted();
        if (time < HistoryEdge || time > Horizon)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"Readable is from {HistoryEdge.ToShortString()}, the edge of the history, to {Horizon.ToShortString()},"
                    + " where the next event is due.");
        }
    }
}
