using System;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Clocks;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// This peer's copy of the shared world: how it is created, how events enter it, and how it is kept ahead of the shared time.
/// </summary>
/// <remarks>For the session's thread; <see cref="Live"/>, its scene and <see cref="DisplayTime"/> from any thread.</remarks>
internal sealed class SharedWorld
{
    private readonly SessionOptions options;
    private readonly IClock clock;
    private readonly SharedClock sharedTime;
    private readonly SessionCounters counters;
    private readonly ILateEventStrategy strategy;
    private readonly CancellationTokenSource interruption = new();
    private Func<SimulationOptions, SimulationOptions> optionsRule = static options => options;
    private bool hasUnshown;
    private SimTime begunAt = SimTime.MaxValue; // the earliest instant of the world; set before the world is
    private volatile LiveWorld? live;
    private volatile Scene? scene;

    /// <param name="scene">The scene that all peers share; null if it is not known yet.</param>
    /// <param name="options">How the session takes part.</param>
    /// <param name="clock">The local clock, by which work is measured.</param>
    /// <param name="sharedTime">The session's time.</param>
    /// <param name="counters">The session's counters.</param>
    /// <exception cref="ArgumentException">The strategy is unknown, or a sync test is requested for one that does not heal.</exception>
    internal SharedWorld(Scene? scene, SessionOptions options, IClock clock, SharedClock sharedTime, SessionCounters counters)
    {
        this.scene = scene;
        this.options = options;
        this.clock = clock;
        this.sharedTime = sharedTime;
        this.counters = counters;
        Limits = new PlayerLimits(options);
        Watchdog = new RuleWatchdog(options.RuleTimeout);
        strategy = LateEventStrategies.Create(options.Strategy, options.DisplayDelay);
        if (options.SyncTest && !(strategy.RewritesPast && strategy.Mode == HealingMode.CausalCone))
        {
            throw new ArgumentException(
                $"The strategy is '{strategy.Name}', which does not heal; a sync test is for one that does:"
                + " healing or interpolation.", nameof(options));
        }
    }

    internal Scene? Scene
    {
        get => scene;
        set => scene = value;
    }

    /// <summary>The world; null before its start is known.</summary>
    internal LiveWorld? Live => live;

    /// <summary>The committed state that it began from; null if it began with the scene.</summary>
    internal WorldSnapshot? BegunFrom { get; private set; }

    /// <summary>The time of its initial state, which includes all earlier events.</summary>
    internal SimTime From => BegunFrom?.Time ?? SimTime.MinValue;

    /// <summary>Ends the world if rules do not return from a call.</summary>
    internal RuleWatchdog Watchdog { get; }

    /// <summary>The limits on what players may do in it.</summary>
    internal PlayerLimits Limits { get; private set; }

    internal bool PromisesAgreement => strategy.PromisesAgreement;

    internal SimDuration DisplayDelay => strategy.DisplayDelay;

    internal SimTime DisplayTime
    {
        get
        {
            SimTime shared = sharedTime.Now;
            return SimTime.Max(shared - DisplayDelay, SimTime.Min(shared, begunAt));
        }
    }

    /// <summary>Has worlds that begin from now on be made with changed options: other parts, or neighbour lists for few bodies.</summary>
    internal void ChangeOptions(Func<SimulationOptions, SimulationOptions> change)
    {
        Func<SimulationOptions, SimulationOptions> before = optionsRule;
        optionsRule = options => change(before(options));
    }

    /// <summary>Makes a running simulation step end soon; from any thread. The world stops for good.</summary>
    internal void Interrupt() => interruption.Cancel();

    /// <summary>Creates the world from the scene at its start, replacing any earlier one.</summary>
    internal void Begin(SimTime start)
    {
        live?.Retire();
        begunAt = start;
        LiveWorld made = new(Scene!, WorldOptions(start), options.Window.LookAhead, options.RenderedPast + DisplayDelay, options.Contacts, options.Crossings,
            options.RuleNotices, Watchdog, options.Losses)
        {
            Work = new WorkLedger(clock),
            WaitsForLateEvents = true,
        };
        Take(made, null);
    }

    /// <summary>Creates the world from a committed state, replacing any earlier one.</summary>
    /// <exception cref="SceneException">The snapshot is not a world of the scene.</exception>
    internal void Begin(WorldSnapshot snapshot)
    {
        live?.Retire();
        LiveWorld copied = new(
            Scene!, snapshot, WorldOptions(snapshot.Start), options.Window.LookAhead, options.RenderedPast + DisplayDelay, options.Contacts, options.Crossings,
            options.RuleNotices, Watchdog, options.Losses)
        {
            Work = new WorkLedger(clock),
            WaitsForLateEvents = true,
        };
        begunAt = copied.Simulation.HistoryEdge;
        Take(copied, snapshot);
    }

    /// <summary>How long it is until the start, as a sentence. The world must exist.</summary>
    internal string BeginsIn => FormattableString.Invariant(
        $"The session begins in {Math.Max(0, (live!.Simulation.Start - sharedTime.Now).ToSeconds()):0.#} s.");

    /// <summary>Whether there is a world and its start has come.</summary>
    internal bool HasBegunBy(SimTime shared) => live is LiveWorld world && shared >= world.Simulation.Start;

    /// <summary>Whether an event may enter this world at all; events from other peers are always checked.</summary>
    internal bool MayEnter(in ExternalEvent external)
    {
        try
        {
            ExternalEventCheck.Throw(external, Scene!);
            return true;
        }
        catch (SceneException)
        {
            return false;
        }
    }

    /// <summary>Applies an event of this peer. The world must exist.</summary>
    /// <exception cref="InvalidOperationException">The event's time is committed already.</exception>
    /// <exception cref="SimulationException">The world cannot be simulated with the event.</exception>
    internal void Submit(in ExternalEvent external)
    {
        LiveWorld world = live!;
        world.NoteLateEvent(CausedBy(external));
        if (world.Submit(external) == SubmitResult.TooOld)
        {
            throw new InvalidOperationException(
                $"Nothing can be done yet: the shared time is {external.Time.ToShortString()}, and what lies before"
                + $" {world.Simulation.HistoryEdge.ToShortString()} is committed.");
        }

        hasUnshown = true;
        Limits.Note(external);
    }

    /// <summary>Applies another peer's accepted event.</summary>
    /// <returns>False if it came too late for the remaining history, and has no effect.</returns>
    internal bool Apply(in ExternalEvent external)
    {
        LiveWorld world = live ?? throw new InvalidOperationException("An event cannot be accepted before there is a world.");
        hasUnshown = true;
        SimTime now = sharedTime.Now;
        counters.AddLateness(now - external.Time);
        world.NoteLateEvent(CausedBy(external));
        SubmitResult result = Enter(world, external, now);
        if (result == SubmitResult.RolledBack && strategy.RewritesPast && external.Time < now)
        {
            counters.Heals++;
        }

        return result != SubmitResult.TooOld;
    }

    /// <summary>Has an event of this peer happen at another time than that at which it was done here: the host moved it.</summary>
    /// <returns>False if it came too late for the remaining history, and has no effect.</returns>
    internal bool Move(in ExternalEvent done, in ExternalEvent moved)
    {
        Retract(done);
        hasUnshown = true;
        Limits.Note(moved);
        return Enter(live!, moved, sharedTime.Now) != SubmitResult.TooOld;
    }

    /// <summary>Retracts an event of this peer that the host refused.</summary>
    internal void Retract(in ExternalEvent external)
    {
        counters.EventsLost += live!.Retract(external) ? 0 : 1;
        Limits.Retract(external);
    }

    /// <summary>Advances the world ahead of the shared time by a bounded number of events. The world must exist.</summary>
    /// <returns>When to step it again, in shared time.</returns>
    /// <exception cref="SimulationException">The world cannot be simulated any further.</exception>
    internal SimTime Step(SimTime shared)
    {
        LiveWorld world = live!;
        SimTime due = world.Step(shared);
        if (world.BlockedBy is SimulationException end && shared - world.BlockedAt > options.Window.History)
        {
            throw end; // the cause is older than the history by now, and cannot be removed
        }

        if (hasUnshown && !world.IsBehind)
        {
            counters.LastShown = sharedTime.Now;
            hasUnshown = false;
        }

        return due;
    }

    /// <summary>The player whose account pays for what an event has computed again.</summary>
    private static byte CausedBy(in ExternalEvent external) => external.PlayerEvent?.Number ?? external.Peer;

    private SubmitResult Enter(LiveWorld world, in ExternalEvent external, SimTime now)
    {
        world.Advance(now); // simulate up to what was shown, so that a change to it counts as a change
        SubmitResult result = strategy.Apply(world, external, now);
        counters.EventsLost += result == SubmitResult.TooOld ? 1 : 0;
        return result;
    }

    private void Take(LiveWorld made, WorldSnapshot? from)
    {
        if (live is not null)
        {
            Limits = new PlayerLimits(options);
            hasUnshown = false;
        }

        live = made;
        BegunFrom = from;
    }

    // The session decides what history to drop, by the watermark; the simulation's own limit would go by its look-ahead.
    private SimulationOptions WorldOptions(SimTime start)
    {
        if (Scene!.Rules is not null)
        {
            Watchdog.Start(); // before there is a world: its making calls OnStart
        }

        return optionsRule(new SimulationOptions(
            start, SimDuration.MaxValue, options.MaxSegments, interruption.Token, options.SyncTest ? HealingMode.SyncTest : strategy.Mode));
    }
}
