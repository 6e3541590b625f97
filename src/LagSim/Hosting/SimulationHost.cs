using System;
using System.Collections.Concurrent;
using System.Threading;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>A world for one machine: simulated ahead of real time on its own thread, acted on and read from the game's.</summary>
/// <remarks>
/// Every member may be called from any thread, but <see cref="RenderSnapshot"/> from one only. An action is stamped when it is done, and
/// seen in the render snapshots that follow a moment later. For several machines see the peers of LagSim.Net, which keep their worlds in
/// the same way.
/// </remarks>
/// <example>
/// A world on one machine; each frame reads it:
/// <code>
/// using SimulationHost host = new(scene, new StopwatchClock());
/// host.Start();
/// host.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0)));
/// if (host.RenderSnapshot.TryRead(ball, host.Now, out BodyState state))
/// {
///     Console.WriteLine($"height {state.Position.Y:F2} m");
/// }
/// </code>
/// </example>
public sealed class SimulationHost : IDisposable
{
    private readonly ConcurrentQueue<ExternalEvent> submitted = new();
    private readonly object stamping = new();
    private readonly CancellationTokenSource stop = new();
    private readonly IClock clock;
    private readonly LiveWorld world;
    private readonly WorldThread thread;
    private readonly RuleWatchdog watchdog;
    private uint lastSequence;
    private volatile bool disposed;

    /// <summary>Creates a world whose scene starts now by the clock. It stands still until <see cref="Start"/>.</summary>
    /// <param name="scene">The scene to simulate.</param>
    /// <param name="clock">The clock; usually a <see cref="StopwatchClock"/>.</param>
    /// <param name="lookAhead">How far ahead of the clock the world is simulated; default two frames.</param>
    /// <param name="contacts">Receives the contacts of this world alone; null, the default, for none. They are confirmed after 2 s.</param>
    /// <param name="crossings">Receives the crossings of sensors of this world alone, likewise; null, the default, for none.</param>
    /// <param name="notices">Receives what the scene's rules tell in this world alone, likewise; null, the default, for none.</param>
    /// <param name="ruleTimeout">How long a call of the scene's rules may take before the world ends because of it, 100 ms to 600 s of real
    /// time; default 10 s. If the call goes on for half as long again, the thread is given up.</param>
    /// <param name="losses">Receives which bodies of this world alone are lost; null, the default, for none. Confirmed as contacts are.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    /// <exception cref="InvalidOperationException">The notices follow a world already.</exception>
    /// <exception cref="SimulationException">The world cannot be simulated from the start; <c>OnStart</c> of rules is called
    /// here.</exception>
    public SimulationHost(
        Scene scene, IClock clock, SimDuration? lookAhead = null, ContactNotices? contacts = null, CrossingNotices? crossings = null,
        RuleNotices? notices = null, SimDuration? ruleTimeout = null, LossNotices? losses = null)
    {
        this.clock = clock ?? throw new ArgumentNullException(nameof(clock));
        watchdog = new RuleWatchdog(ruleTimeout);
        SimulationOptions options = new(clock.Now, SimDuration.FromSeconds(2), cancellation: stop.Token);
        if (scene?.Rules is not null)
        {
            watchdog.Start(); // before there is a world: its making calls OnStart
        }

        world = new LiveWorld(
            scene!, options, lookAhead, contacts: contacts, crossings: crossings, notices: notices, watchdog: watchdog, losses: losses);
        thread = new WorldThread("LagSim world", Step, stop.Cancel);
    }

    internal LiveWorld World => world;

    /// <summary>Ends the world if rules do not return from a call.</summary>
    internal RuleWatchdog Watchdog => watchdog;

    /// <summary>
    /// The clock's time: what to read the render snapshot at. From any thread, if the clock can be read so, as a
    /// <see cref="StopwatchClock"/> can.
    /// </summary>
    public SimTime Now => clock.Now;

    /// <summary>The newest render snapshot, for the one reading thread.</summary>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception, the inner one.</exception>
    public RenderSnapshot RenderSnapshot
    {
        get
        {
            thread.ThrowIfFaulted();
            return world.RenderSnapshots.Latest();
        }
    }

    /// <summary>Receives contacts; null for none. For the game's thread <see cref="ContactNotices.TryRead"/>.</summary>
    public ContactNotices? Contacts => world.Contacts;

    /// <summary>Receives crossings of sensors; null for none. For the game's thread <see cref="CrossingNotices.TryRead"/>.</summary>
    public CrossingNotices? Crossings => world.Crossings;

    /// <summary>Receives which bodies are lost; null for none. For the game's thread <see cref="LossNotices.TryRead"/>.</summary>
    public LossNotices? Losses => world.Losses;

    /// <summary>How often the clock was beyond what was simulated when a step began.</summary>
    public long LateSteps => world.LateSteps;

    /// <summary>How far the clock was beyond what was simulated when a step began, at most.</summary>
    public SimDuration MaxLateness => world.MaxLateness;

    /// <summary>
    /// Whether there is more to simulate than could be done by now, so that <see cref="RenderSnapshot"/> ends before <see cref="Now"/> or
    /// soon after.
    /// </summary>
    public bool IsBehind => world.IsBehind;

    /// <summary>How many steps the thread has done; a world at rest does none.</summary>
    public long Steps => thread.Steps;

    /// <summary>Starts the thread.</summary>
    /// <exception cref="InvalidOperationException">It has been started already.</exception>
    /// <exception cref="ObjectDisposedException">It has been stopped for good.</exception>
    public void Start()
    {
        watchdog.Abandoned = thread.Abandon;
        thread.Start();
    }

    /// <summary>
    /// Applies an action to the world, now by the clock. The render snapshot has it as soon as the world's thread has simulated it. From
    /// any thread.
    /// </summary>
    /// <returns>The stamped event; for a spawn, <see cref="ExternalEvent.Body"/> is the new body.</returns>
    /// <remarks>
    /// An action on a body that is not there, or one that gives it more speed than allowed, has no effect; see
    /// <see cref="Simulation.TookEffect"/>.
    /// </remarks>
    /// <exception cref="SceneException">A value may not enter the world; nothing happened.</exception>
    /// <exception cref="ObjectDisposedException">The thread has been stopped for good; nothing would come of it.</exception>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception, the inner one.</exception>
    public ExternalEvent Do(in PlayerAction action)
    {
        thread.ThrowIfFaulted();
        if (disposed)
        {
            throw new ObjectDisposedException(nameof(SimulationHost));
        }

        ExternalEvent external;
        lock (stamping)
        {
            external = action.Stamp(clock.Now, 0, lastSequence + 1);
            ExternalEventCheck.Throw(external, world.Simulation.Scene);
            lastSequence++;
            submitted.Enqueue(external);
        }

        thread.Wake();
        return external;
    }

    /// <summary>
    /// Stops the thread, in the middle of its work if it is at some, and waits for it; if rules do not return from a call, until it is
    /// given up. The last render snapshot stays readable; nothing more can be done to the world.
    /// </summary>
    public void Dispose()
    {
        disposed = true;
        thread.Dispose();
        watchdog.Dispose();
    }

    private SimDuration Step()
    {
        while (submitted.TryDequeue(out ExternalEvent external))
        {
            world.Submit(external);
        }

        SimTime due = world.Step(clock.Now);
        return due == SimTime.MaxValue ? SimDuration.MaxValue : due - clock.Now; // what the step itself took is not waited again
    }
}
