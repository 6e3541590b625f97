using System;
using System.Threading;
using LagSim.BroadPhase;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>A simulation kept ahead of a clock: it is advanced to now plus the look-ahead, and its render snapshot published.</summary>
/// <remarks>
/// For the simulation's thread, in real or virtual time alike, with three exceptions: <see cref="RenderSnapshots"/> is how another thread
/// reads, any thread may read <see cref="LateSteps"/> and <see cref="MaxLateness"/>, each for itself, and <see cref="Contacts"/> states its
/// own rules. All changes of the world go through this type, so that the next <see cref="Step"/> publishes them.
/// </remarks>
public sealed class LiveWorld
{
    /// <summary>The default length of the past that render snapshots show: 250 ms.</summary>
    public static readonly SimDuration DefaultRenderedPast = SimDuration.FromMilliseconds(250);

    /// <summary>
    /// The default cost limit of a step, as <see cref="Effort"/> counts: some hundredths of a second for a heap, which costs most.
    /// </summary>
    private const long DefaultEffort = 8_192;

    /// <summary>However many bodies there are, so many events a step: it has to get on.</summary>
    private const long MinEvents = 16;

    private readonly SimDuration renderedPast;
    private bool changed = true;
    private volatile bool isBehind;
    private SimTime shownTo = SimTime.MinValue; // how far the newest render snapshot's world was simulated
    // How far the newest render snapshot can be read; before there is one no reader waits for it.
    private SimTime renderedTo = SimTime.MaxValue;
    private long maxRenderLateness;
    private long events; // how many may still happen before the next step
    private long lateSteps;
    private long maxLatenessTicks;

    /// <summary>Keeps a new simulation of the scene ahead.</summary>
    /// <param name="scene">The scene to simulate.</param>
    /// <param name="options">Start and history; the history must exceed the look-ahead.</param>
    /// <param name="lookAhead">How far ahead of the clock, above zero and at most 1 s; default two frames.</param>
    /// <param name="renderedPast">How much of the past render snapshots show, at least zero; default 250 ms.</param>
    /// <param name="contacts">Receives the contacts of this world alone; null, the default, for none.</param>
    /// <param name="crossings">Receives the crossings of sensors of this world alone; null, the default, for none.</param>
    /// <param name="notices">Receives what the scene's rules tell in this world alone; null, the default, for none.</param>
    /// <param name="watchdog">Ends this world if rules do not return from a call; null, the default, for none. <see
    /// cref="RuleWatchdog.Start"/> it before, since making a world calls <c>OnStart</c>.</param>
    /// <param name="losses">Receives which bodies of this world alone are lost; null, the default, for none.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    /// <exception cref="InvalidOperationException">The notices follow a world already.</exception>
    public LiveWorld(Scene scene, SimulationOptions options, SimDuration? lookAhead = null, SimDuration? renderedPast = null, ContactNotices? contacts = null,
        CrossingNotices? crossings = null, RuleNotices? notices = null, RuleWatchdog? watchdog = null, LossNotices? losses = null)
        : this(
            new Simulation(scene, Checked(options, lookAhead, renderedPast, contacts, crossings, notices, watchdog, losses)), lookAhead,
            renderedPast, contacts, crossings, notices, losses)
    {
    }

    /// <summary>Keeps a simulation that continues from a snapshot ahead.</summary>
    /// <param name="scene">The scene to simulate.</param>
    /// <param name="snapshot">The snapshot to continue from.</param>
    /// <param name="options">The history, which must exceed the look-ahead.</param>
    /// <param name="lookAhead">How far ahead of the clock, above zero and at most 1 s; default two frames.</param>
    /// <param name="renderedPast">How much of the past render snapshots show, at least zero; default 250 ms.</param>
    /// <param name="contacts">Receives the contacts of this world alone; null, the default, for none.</param>
    /// <param name="crossings">Receives the crossings of sensors of this world alone; null, the default, for none.</param>
    /// <param name="notices">Receives what the scene's rules tell in this world alone; null, the default, for none.</param>
    /// <param name="watchdog">Ends this world if rules do not return from a call; null, the default, for none. <see
    /// cref="RuleWatchdog.Start"/> it before, since making a world calls <c>OnStart</c>.</param>
    /// <param name="losses">Receives which bodies of this world alone are lost; null, the default, for none.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    /// <exception cref="InvalidOperationException">The notices follow a world already.</exception>
    /// <exception cref="SceneException">The snapshot is of no world of the scene.</exception>
    public LiveWorld(
        Scene scene, WorldSnapshot snapshot, SimulationOptions options, SimDuration? lookAhead = null, SimDuration? renderedPast = null,
        ContactNotices? contacts = null, CrossingNotices? crossings = null, RuleNotices? notices = null, RuleWatchdog? watchdog = null,
        LossNotices? losses = null)
        : this(
            new Simulation(scene, snapshot, Checked(options, lookAhead, renderedPast, contacts, crossings, notices, watchdog, losses)),
            lookAhead, renderedPast, contacts, crossings, notices, losses)
    {
    }

    private LiveWorld(
        Simulation simulation, SimDuration? lookAhead, SimDuration? renderedPast, ContactNotices? contacts, CrossingNotices? crossings,
        RuleNotices? notices, LossNotices? losses)
    {
        Notices = notices;
        if (notices is not null)
        {
            simulation.Engine.Rules?.Listen();
        }

        contacts?.Begin(simulation.HistoryEdge);
        crossings?.Begin(simulation.HistoryEdge);
        notices?.Begin(simulation.HistoryEdge);
        losses?.Begin(simulation.HistoryEdge);
        Simulation = simulation;
        Contacts = contacts;
        Crossings = crossings;
        Losses = losses;
        events = EventsAStep;
        LookAhead = lookAhead ?? LatencyCompensationWindow.DefaultLookAhead;
        this.renderedPast = renderedPast ?? DefaultRenderedPast;
    }

    /// <summary>The world. For reading; submit to this type, not to it.</summary>
    public Simulation Simulation { get; }

    /// <summary>How far ahead of the clock it is simulated.</summary>
    public SimDuration LookAhead { get; }

    /// <summary>Receives its contacts; null for none.</summary>
    public ContactNotices? Contacts { get; }

    /// <summary>Receives its crossings of sensors; null for none.</summary>
    public CrossingNotices? Crossings { get; }

    /// <summary>Receives what its rules tell; null for none.</summary>
    public RuleNotices? Notices { get; }

    /// <summary>Receives which of its bodies are lost; null for none.</summary>
    public LossNotices? Losses { get; }

    /// <summary>
    /// Keeps account of what players' acts cost, and bounds what a step may cost by it; null, the default, for none. Of one world at a
    /// time. It changes no bit of what happens.
    /// </summary>
    public WorkLedger? Work
    {
        get => (WorkLedger?)Simulation.Engine.Meter.Observer;
        set => Simulation.Engine.Meter.Observer = value;
    }

    /// <summary>Where another thread, one only, gets its render snapshot.</summary>
    public RenderTripleBuffer RenderSnapshots { get; } = new();

    /// <summary>How often a step found the clock beyond what was simulated, so that a reader had to stall. From any thread.</summary>
    public long LateSteps => Volatile.Read(ref lateSteps);

    /// <summary>The furthest the clock was beyond what was simulated when a step began. From any thread.</summary>
    public SimDuration MaxLateness => SimDuration.FromTicks(Volatile.Read(ref maxLatenessTicks));

    /// <summary>
    /// How far the newest render snapshot can be read. During a rollback it stays where it was, though <see cref="Simulation.SimulatedTo"/>
    /// goes back. The latest time there is before the first render snapshot. On the simulation's thread.
    /// </summary>
    public SimTime RenderedTo => renderedTo;

    /// <summary>
    /// The furthest that the clock was beyond the newest render snapshot when a step began, so that a reader had nothing newer to show.
    /// From any thread.
    /// </summary>
    public SimDuration MaxRenderLateness => SimDuration.FromTicks(Volatile.Read(ref maxRenderLateness));

    /// <summary>
    /// Whether the world is not where it should be, <see cref="LookAhead"/> beyond the clock of the last <see cref="Step"/> or
    /// <see cref="Advance"/>, because there was more to do than one step may do; the next step continues. From any thread.
    /// </summary>
    public bool IsBehind => isBehind;

    /// <summary>
    /// The cost limit of a step, in tests of one body against another: an event of a body tests all others, or those that the broad phase
    /// names. Counted, not timed, so that where a step stops depends on the world alone.
    /// </summary>
    internal long Effort { get; set; } = DefaultEffort;

    private long EventsAStep => Math.Max(MinEvents, Effort / (Math.Min(Simulation.BodyCount, AdaptiveBroadPhase.UsualCandidates) + 8));

    /// <summary>
    /// Gives the notices free for the world that takes this one's place; what was predicted and not confirmed is in doubt until that world
    /// has it too, or does not. Not to be stepped again.
    /// </summary>
    public void Retire()
    {
        Contacts?.Restart();
        Crossings?.Restart();
        Notices?.Restart();
        Losses?.Restart();
    }

    /// <summary>
    /// Whether a step may end within an instant, and whether an instant in which the game's rules fail blocks the world until an
    /// event comes that lies no later than it; default no: then an instant happens as a whole, and such a one ends the simulation.
    /// </summary>
    /// <remarks>
    /// For a session, because its host removes the cause. Without effect in a sync test (<see cref="HealingMode.SyncTest"/>). On the
    /// world's thread.
    /// </remarks>
    public bool WaitsForLateEvents
    {
        get => Simulation.WaitsForLateEvents;
        set => Simulation.WaitsForLateEvents = value;
    }

    /// <summary>The instant that blocks the world, if it <see cref="WaitsForLateEvents"/>; the latest time there is if none does.</summary>
    public SimTime BlockedAt => Simulation.Engine.Loop.BlockedAt;

    /// <summary>Why an instant blocks the world: with what it ends once nothing can remove the cause any more. Null if none does.</summary>
    public SimulationException? BlockedBy => Simulation.Engine.Loop.Blocked?.AsEnd();

    /// <summary>Notifies <see cref="Work"/>, if there is one, which peer's event is submitted next.</summary>
    /// <param name="player">The player's number.</param>
    public void NoteLateEvent(byte player) => Work?.NoteLateEvent(player, Simulation.Engine.Rollback.IsActive);

    /// <summary>Submits an event at its own time.</summary>
    /// <remarks>
    /// Re-simulation for a late event is done at once, because a session's host judges the next event by what the world is then. It counts
    /// as this step's work. Once that is used up, late events are only marked, and the next step heals all of them together; the world is
    /// behind meanwhile.
    /// </remarks>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    public SubmitResult Submit(in ExternalEvent external)
    {
        Change change = new(this);
        return change.Finish(Simulation.Submit(external));
    }

    /// <summary>Submits an event that takes effect at its arrival; see <see cref="Simulation.SubmitForwarded"/>.</summary>
    /// <exception cref="SceneException">The event carries a value that may not enter the world; nothing changed.</exception>
    public SubmitResult SubmitForwarded(in ExternalEvent external, SimTime arrival)
    {
        Change change = new(this);
        return change.Finish(Simulation.SubmitForwarded(external, arrival));
    }

    /// <summary>Retracts an event; see <see cref="Simulation.Retract"/>.</summary>
    public bool Retract(in ExternalEvent external)
    {
        Change change = new(this);
        return change.Finish(Simulation.Retract(external));
    }

    /// <summary>
    /// Brings the world ahead of <paramref name="now"/>, without publishing, as far as this step's work goes; see <see cref="IsBehind"/>.
    /// </summary>
    public void Advance(SimTime now)
    {
        SimTime target = SimTime.Max(now, Simulation.Start) + LookAhead;
        changed |= Simulation.Horizon < target && Simulation.Engine.Loop.Blocked is null;
        Work?.Resume();
        isBehind = target > Simulation.SimulatedTo && !Simulation.TryAdvanceTo(target, ref events);
    }

    /// <summary>Brings the world ahead of <paramref name="now"/> again and publishes it if it changed.</summary>
    /// <returns>
    /// When the next step is due if nothing changes before: <paramref name="now"/> while the world <see cref="IsBehind"/>, but a look-ahead
    /// later while an instant blocks it, and <see cref="SimTime.MaxValue"/> for a world in which nothing will happen, and of which no
    /// contact is to be confirmed.
    /// </returns>
    /// <remarks>
    /// It does a bounded number of events, so that the caller can do other things in between. While a rollback takes several steps the last
    /// complete render snapshot stays, until the world has caught up with it. Half of the look-ahead may be used up before the next step is
    /// due, so a moving world steps about once a frame, one at rest never.
    /// </remarks>
    public SimTime Step(SimTime now)
    {
        if (Simulation.Horizon < now)
        {
            long late = (now - Simulation.Horizon).Ticks;
            Volatile.Write(ref lateSteps, lateSteps + 1);
            Volatile.Write(ref maxLatenessTicks, Math.Max(maxLatenessTicks, late));
        }

        if (renderedTo < now && changed)
        {
            Volatile.Write(ref maxRenderLateness, Math.Max(maxRenderLateness, (now - renderedTo).Ticks));
        }

        events = EventsAStep;
        Work?.BeginStep();
        Advance(now);
        if (changed && !(isBehind && Simulation.SimulatedTo < shownTo))
        {
            // A world that is behind publishes how far it is; but a world that rewound to heal is not shown running a second time.
            shownTo = Simulation.SimulatedTo;
            SimTime from = SimTime.Min(SimTime.Max(now, Simulation.Start), Simulation.SimulatedTo) - renderedPast;
            RenderSnapshots.Publish(Simulation, SimTime.Max(from, Simulation.HistoryEdge));
            renderedTo = Simulation.Horizon;
            changed = false;
        }

        if (!Simulation.Engine.Loop.IsPartDone)
        {
            Contacts?.Tell(Simulation);
            Crossings?.Tell(Simulation);
            Notices?.Tell(Simulation);
            Losses?.Tell(Simulation);
        }

        SimDuration history = Simulation.Engine.Progress.History;
        SimTime confirmation = SimTime.Min(
            Contacts?.NextDue(history, LookAhead) ?? SimTime.MaxValue, Crossings?.NextDue(history, LookAhead) ?? SimTime.MaxValue);
        confirmation = SimTime.Min(confirmation, Notices?.NextDue(history, LookAhead) ?? SimTime.MaxValue);
        confirmation = SimTime.Min(confirmation, Losses?.NextDue(history, LookAhead) ?? SimTime.MaxValue);
        if (Simulation.Engine.Loop.Blocked is not null)
        {
            return SimTime.Min(confirmation, now + LookAhead); // there is nothing to do before an event comes
        }

        return isBehind ? now : SimTime.Min(confirmation, Simulation.Horizon == SimTime.MaxValue ? SimTime.MaxValue : Simulation.Horizon - (LookAhead / 2));
    }

    /// <summary>The options, if they and the spans go together.</summary>
    private static SimulationOptions Checked(
        SimulationOptions options, SimDuration? lookAhead, SimDuration? renderedPast, ContactNotices? contacts, CrossingNotices? crossings,
        RuleNotices? notices, RuleWatchdog? watchdog, LossNotices? losses)
    {
        if (options is null)
        {
            throw new ArgumentNullException(nameof(options));
        }

        SimDuration ahead = lookAhead ?? LatencyCompensationWindow.DefaultLookAhead;
        if (ahead <= SimDuration.Zero || ahead > LatencyCompensationWindow.MaxLookAhead)
        {
            throw new ArgumentOutOfRangeException(nameof(lookAhead), ahead.ToShortString(), "The look-ahead must be above zero and at most 1 s.");
        }

        if (renderedPast < SimDuration.Zero)
        {
            throw new ArgumentOutOfRangeException(
                nameof(renderedPast), renderedPast.Value.ToShortString(), "The past that render snapshots show must be zero or more.");
        }

        if (options.History <= ahead)
        {
            throw new ArgumentOutOfRangeException(nameof(options), options.History.ToShortString(), $"The history must exceed the look-ahead,"
                + $" {ahead.ToShortString()}.");
        }

        contacts?.Follow();
        notices?.Follow();
        crossings?.Follow();
        losses?.Follow();
        options = watchdog is null ? options : options.WithRunningRuleCall(watchdog.Running);
        options = contacts is null ? options : options.WithObserver(contacts);
        options = crossings is null ? options : options.WithCrossingObserver(crossings);
        return losses is null ? options : options.WithLossObserver(losses);
    }

    /// <summary>
    /// A change of the world: the paths that a late event undoes are re-simulated as part of the step's work, which may end before that is
    /// done.
    /// </summary>
    private readonly ref struct Change
    {
        private readonly LiveWorld world;
        private readonly SimTime simulatedBefore;
        private readonly long cutBefore;

        internal Change(LiveWorld world)
        {
            this.world = world;
            simulatedBefore = world.Simulation.SimulatedTo;
            cutBefore = world.Simulation.Engine.Rollback.SegmentsCut;
            world.changed = true;
            world.Work?.Resume();
        }

        internal T Finish<T>(T result)
        {
            if (world.Simulation.SimulatedTo < simulatedBefore)
            {
                // The instant of a late event is simulated at once, whatever this step may still cost. Otherwise one such event a step
                // would keep the world there.
                long all = long.MaxValue;
                world.Simulation.TryAdvanceTo(world.Simulation.SimulatedTo + SimDuration.OneTick, ref all);
            }

            world.Work?.ChargeLateEvent(world.Simulation.SimulatedTo, world.Simulation.Engine.Rollback.SegmentsCut - cutBefore);
            if (world.Simulation.SimulatedTo < simulatedBefore)
            {
                world.isBehind |= !world.Simulation.TryAdvanceTo(simulatedBefore, ref world.events);
            }

            return result;
        }
    }
}
