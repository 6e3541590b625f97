using System;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>One peer's part in a shared world: it talks through a datagram port, keeps the shared time, and keeps a world ahead of it.</summary>
/// <remarks>
/// For one thread, in real time (<see cref="PeerThread"/> gives it one) or in virtual time, where the harness steps it. From any thread may
/// be read: <see cref="Scene"/>, <see cref="SharedTime"/>, <see cref="State"/>, <see cref="EndReason"/>, and which <see cref="World"/> it is;
/// of the world itself only its pictures, its counts of late steps, and when it started.
/// </remarks>
public abstract class Session
{
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly ILateEventStrategy strategy;
    private readonly UpdateDatagram received = new();
    private readonly CancellationTokenSource interruption = new();
    private bool hasUnshown;
    private volatile SessionState state;
    private volatile string? endReason;
    private volatile LiveWorld? world;

    private protected Session(Scene scene, IDatagramPort port, IClock clock, SessionOptions options)
    {
        Scene = scene ?? throw new ArgumentNullException(nameof(scene));
        Port = port ?? throw new ArgumentNullException(nameof(port));
        Clock = clock ?? throw new ArgumentNullException(nameof(clock));
        Options = options ?? throw new ArgumentNullException(nameof(options));
        options.Check();
        strategy = LateEventStrategies.Create(options.Strategy);
        SharedTime = new SharedClock(clock);
    }

    /// <summary>The scene that all peers share.</summary>
    public Scene Scene { get; }

    /// <summary>The session's time; readable once <see cref="SharedClock.IsSet"/>, from any thread.</summary>
    public SharedClock SharedTime { get; }

    /// <summary>Where the peer stands. From any thread.</summary>
    public SessionState State
    {
        get => state;
        private protected set => state = value;
    }

    /// <summary>Why the session ended, as a sentence; null while it goes on. From any thread: it is there once <see cref="State"/> says so.</summary>
    public string? EndReason => endReason;

    /// <summary>This peer's number; 0 is the host. Meaningful once joined.</summary>
    public byte Peer { get; private protected set; }

    /// <summary>The world, from the moment its start is known; the same from then on. From any thread, but see the remarks for what is in it.</summary>
    public LiveWorld? World => world;

    /// <summary>What was counted.</summary>
    public SessionCounters Counters { get; } = new();

    /// <summary>Whether all peers with this strategy end up with the same world, bit for bit.</summary>
    public bool PromisesAgreement => strategy.PromisesAgreement;

    private protected IDatagramPort Port { get; }

    private protected IClock Clock { get; }

    private protected SessionOptions Options { get; }

    /// <summary>The number of this peer's newest event.</summary>
    private protected uint LastSequence { get; private set; }

    /// <summary>Does what is due: takes in datagrams, brings the world ahead, sends.</summary>
    /// <returns>How long until something is due again, unless a datagram or an action comes first.</returns>
    /// <remarks>A world that cannot be simulated any further ends the session, with the reason; whatever others send, it does not throw.</remarks>
    public SimDuration Step()
    {
        try
        {
            return StepOnce();
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            return SimDuration.MaxValue;
        }
    }

    /// <summary>Does something to the shared world, now: seen here at once, by the others as soon as they hear of it.</summary>
    /// <returns>The stamped event; of a spawn, <see cref="ExternalEvent.Body"/> is the new body.</returns>
    /// <exception cref="InvalidOperationException">The session is not running.</exception>
    /// <exception cref="SceneException">A value may not enter the world; nothing happened.</exception>
    /// <exception cref="SimulationException">The world cannot be simulated with it; the session has ended.</exception>
    public ExternalEvent Do(in PlayerAction action)
    {
        if (State != SessionState.Ended && SharedTime.IsSet)
        {
            BeginRunning(SharedTime.Now);
        }

        if (State != SessionState.Running || World is null)
        {
            throw new InvalidOperationException($"Nothing can be done while the session is {State}; wait until it is Running.");
        }

        ExternalEvent external = action.Stamp(SharedTime.Now, Peer, LastSequence + 1);
        try
        {
            World.Submit(external);
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            throw;
        }

        hasUnshown = true;
        LastSequence++;
        Publish(external);
        return external;
    }

    /// <summary>Has a step that is simulating end soon, by an <see cref="OperationCanceledException"/>; from any thread. The world stands still from then on.</summary>
    internal void Interrupt() => interruption.Cancel();

    /// <summary>Says goodbye and ends the session. The world stays readable.</summary>
    public void Leave()
    {
        if (State != SessionState.Ended)
        {
            Farewell();
            End("This peer left.");
        }
    }

    private protected abstract void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from);

    private protected abstract void OnUpdate(UpdateDatagram update, PeerAddress from);

    /// <summary>Whatever is due by the own clock, sending included.</summary>
    private protected abstract void Tend(SimTime now);

    private protected abstract SimTime NextDue(SimTime now);

    /// <summary>Sees to it that the others hear of an own event.</summary>
    private protected abstract void Publish(in ExternalEvent external);

    private protected abstract void Farewell();

    private protected void End(string reason)
    {
        endReason ??= reason; // first: who reads that it ended reads why
        State = SessionState.Ended;
    }

    /// <summary>Makes the world, once its start is known.</summary>
    private protected void Begin(SimTime start)
    {
        // The session itself decides what is forgotten, by the watermark; the simulation's own limit would go by its look-ahead.
        world ??= new LiveWorld(
            Scene, new SimulationOptions(start, SimDuration.MaxValue, cancellation: interruption.Token), Options.LookAhead, Options.PicturePast);
    }

    /// <summary>Brings another peer's accepted event into the world.</summary>
    private protected void Apply(in ExternalEvent external)
    {
        if (World is null)
        {
            throw new InvalidOperationException("An event cannot be accepted before there is a world.");
        }

        hasUnshown = true;
        SimTime now = SharedTime.Now;
        Counters.AddLateness(now - external.Time);
        World.Advance(now); // what was shown up to now is simulated, so what changes it counts as changed
        switch (strategy.Apply(World, external, now))
        {
            case SubmitResult.RolledBack when strategy.RewritesPast && external.Time < now:
                Counters.Heals++;
                break;
            case SubmitResult.TooOld:
                Counters.EventsLost++;
                break;
        }
    }

    /// <summary>Whether the event may enter this world at all; what others send is not trusted to be checked.</summary>
    private protected bool MayEnter(in ExternalEvent external)
    {
        try
        {
            ExternalEventCheck.Throw(external, Scene);
            return true;
        }
        catch (SceneException)
        {
            return false;
        }
    }

    /// <summary>Nothing before the watermark will change any more; forget it, but for what the options want kept.</summary>
    private protected void Commit(SimTime watermark) => World?.Simulation.DropHistoryBefore(watermark - Options.ExtraHistory);

    /// <summary>
    /// Whether one end of a link has not heard of the other when it should have. They then write as if something were unacknowledged: else a
    /// burst of losses, which is counted in datagrams, would last as long as the timeout.
    /// </summary>
    private protected bool IsOverdue(SimDuration silence) => silence > Options.KeepAlive + (Options.KeepAlive / 4);

    /// <summary>How long to wait before the next update.</summary>
    private protected SimDuration WaitAfterUpdate(bool hasUnacknowledged, SimDuration silence) =>
        hasUnacknowledged || IsOverdue(silence) ? Options.ResendInterval : Options.KeepAlive;

    /// <summary>Counts a datagram that could not be decoded.</summary>
    private protected bool IsWellFormed(bool decoded)
    {
        Counters.DatagramsMalformed += decoded ? 0 : 1;
        return decoded;
    }

    private protected void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        Port.Send(datagram, to);
        Counters.DatagramsSent++;
    }

    private SimDuration StepOnce()
    {
        while (Port.TryReceive(buffer, out int length, out PeerAddress from))
        {
            Counters.DatagramsReceived++;
            Receive(buffer.AsSpan(0, length), from);
        }

        SimTime now = Clock.Now;
        if (State != SessionState.Ended)
        {
            Tend(now);
        }

        SimTime due = State == SessionState.Ended ? SimTime.MaxValue : NextDue(now);
        if (World is not null && State != SessionState.Ended)
        {
            SimTime shared = SharedTime.Now;
            SimTime worldDue = World.Step(shared);
            if (hasUnshown)
            {
                Counters.LastShown = SharedTime.Now;
                hasUnshown = false;
            }

            if (worldDue != SimTime.MaxValue)
            {
                // A shared clock that is behind is bent to run up to 5 % fast: by the own clock the time then comes that much sooner.
                SimDuration left = worldDue - shared;
                due = SimTime.Min(due, now + (SharedTime.Remaining > SimDuration.Zero ? left - (left / 20) : left));
            }

            BeginRunning(shared);
            if (State != SessionState.Running)
            {
                due = SimTime.Min(due, now + (World.Simulation.Start - shared));
            }
        }

        return due == SimTime.MaxValue ? SimDuration.MaxValue : due - Clock.Now; // what the step itself took is not waited again
    }

    /// <summary>Nothing is to be read from a world that failed; the pictures that were published still can be.</summary>
    private void EndWorld(SimulationException failure)
    {
        Farewell();
        End($"The world cannot be simulated any further. {failure.Message}");
    }

    private void BeginRunning(SimTime shared)
    {
        if (World is not null && shared >= World.Simulation.Start)
        {
            State = SessionState.Running;
        }
    }

    private void Receive(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        WireRefusal refusal;
        if (!WireFormat.TryReadType(datagram, out DatagramType type, out refusal))
        {
            Counters.DatagramsMalformed++;
        }
        else if (type != DatagramType.Update)
        {
            OnDatagram(type, datagram, from);
        }
        else if (received.TryDecode(datagram, out refusal))
        {
            OnUpdate(received, from);
        }
        else
        {
            Counters.DatagramsMalformed++;
        }
    }
}
