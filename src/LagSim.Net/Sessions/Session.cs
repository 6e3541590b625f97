using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Security.Cryptography;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>
/// One peer's part in a shared world: it talks through a datagram port, keeps the shared time, and keeps a world ahead of it.
/// </summary>
/// <remarks>
/// For one thread, in real time (<see cref="PeerThread"/> gives it one) or in virtual time, where the harness steps it. From any thread may
/// be read: <see cref="Scene"/>, <see cref="SharedTime"/>, <see cref="State"/>, <see cref="EndReason"/>, <see cref="Committed"/>, and which
/// <see cref="World"/> it is; of the world itself only its render snapshots, its counts of late steps, and when it started. While a
/// <see cref="PeerThread"/> runs it, what is for the session's thread throws an <see cref="InvalidOperationException"/> on any other. A
/// handler of an event that throws ends nothing then, and <see cref="PeerThread.HandlerFailed"/> tells; where there is no such thread, what
/// it throws goes through to whoever calls <see cref="Step"/>, or what else raised the event.
/// </remarks>
public abstract class Session
{
    /// <summary>The version of the wire format: peers of different versions do not talk to each other, and say so.</summary>
    public const byte WireVersion = WireFormat.Version;

    private readonly SessionParts parts;
    private readonly ISessionProtocol protocol;
    private readonly SessionLoop loop;
    private readonly CancellationTokenRegistration watch;
    private readonly HandlerList<Action> begun;
    private readonly HandlerList<Action<string>> renewed;
    private readonly HandlerList<Action> ended;
    private readonly HandlerList<Action<LogEntry>> logged;
    private readonly HandlerList<Action<CommittedState>> stateCommitted;

    private protected Session(SessionParts parts, ISessionProtocol protocol)
    {
        begun = new(parts.Owner);
        renewed = new(parts.Owner);
        ended = new(parts.Owner);
        logged = new(parts.Owner);
        stateCommitted = new(parts.Owner);
        this.parts = parts;
        this.protocol = protocol;
        loop = new SessionLoop(parts, protocol);
        watch = parts.Options.Cancellation.Register(static session => ((Session)session!).Interrupt(), this);
        parts.Status.Ended += () => watch.Dispose(); // a token of the whole program would keep all sessions there ever were
        parts.Start.Begun += () => begun.Raise(0, static (handler, _) => handler());
        parts.Start.Renewed += why => renewed.Raise(why, static (handler, told) => handler(told));
        parts.Status.Ended += () => ended.Raise(0, static (handler, _) => handler());
        parts.Journal.Told += entry => logged.Raise(entry, static (handler, told) => handler(told));
        parts.Commits.Committed += state => stateCommitted.Raise(state, static (handler, told) => handler(told));
    }

    /// <summary>
    /// Raised on the session's thread, once, when there is a <see cref="World"/> and nothing has happened in it yet.
    /// </summary>
    public event Action? Begun
    {
        add => begun.Add(value);
        remove => begun.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread each time that a fresh copy of the host's world has taken the place of <see cref="World"/>, which is
    /// another object from then on, with why. What this peer did that the host had not validated is in neither.
    /// </summary>
    public event Action<string>? Renewed
    {
        add => renewed.Add(value);
        remove => renewed.Remove(value);
    }

    /// <summary>Raised on the thread that ended the session, once; <see cref="EndReason"/> tells why.</summary>
    public event Action? Ended
    {
        add => ended.Add(value);
        remove => ended.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread for every line of the log, in order, once it has taken effect here.
    /// </summary>
    public event Action<LogEntry>? Logged
    {
        add => logged.Add(value);
        remove => logged.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread for every committed state, in order; see <see cref="SessionOptions.CommitInterval"/>.
    /// </summary>
    /// <remarks>A world that is behind commits later.</remarks>
    public event Action<CommittedState>? StateCommitted
    {
        add => stateCommitted.Add(value);
        remove => stateCommitted.Remove(value);
    }

    /// <summary>The scene that all peers share; null for a client that has not heard of it. From any thread.</summary>
    public Scene? Scene => parts.World.Scene;

    /// <summary>The session's time; readable once <see cref="SharedClock.IsSet"/>, from any thread.</summary>
    public SharedClock SharedTime => parts.SharedTime;

    /// <summary>
    /// How far behind the shared time this peer shows the world: <see cref="SessionOptions.DisplayDelay"/> with <c>interpolation</c>, else
    /// zero. From any thread.
    /// </summary>
    public SimDuration DisplayDelay => parts.World.DisplayDelay;

    /// <summary>
    /// What a frame that is drawn now reads of a render snapshot: shared time less <see cref="DisplayDelay"/>. In the first moments, when
    /// that lies before the world this peer has, the earliest instant of it, so that the world stands still until it can be shown on its
    /// way. From any thread, once there is a <see cref="World"/>.
    /// </summary>
    public SimTime DisplayTime => parts.World.DisplayTime;

    /// <summary>Where the peer stands. From any thread.</summary>
    public SessionState State => parts.Status.State;

    /// <summary>
    /// Why the session ended, as a sentence; null while it goes on. From any thread: it is there once <see cref="State"/> says so.
    /// </summary>
    public string? EndReason => parts.Status.EndReason;

    /// <summary>What ended the session. From any thread, as <see cref="EndReason"/>.</summary>
    public SessionEnd EndedBy => parts.Status.EndedBy;

    /// <summary>This peer's number; 0 is the host. Meaningful once joined.</summary>
    public byte Peer => parts.Self.Number;

    /// <summary>
    /// The world, from the moment its start is known; the same from then on, but for a client that got a fresh copy
    /// (<see cref="Renewed"/>). From any thread, but see the remarks for what is in it.
    /// </summary>
    public LiveWorld? World => parts.World.Live;

    /// <summary>
    /// What the world went on from, for a client that came late enough; null where it began with the scene. On the session's thread.
    /// </summary>
    public WorldSnapshot? BegunFrom
    {
        get
        {
            parts.Owner.ThrowIfForeign();
            return parts.World.BegunFrom;
        }
    }

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    public CommittedState? Committed => parts.Commits.Newest;

    /// <summary>
    /// How many lines of the host's log this peer was not told, because every accepted event in them is in <see cref="BegunFrom"/>; the
    /// next is the first that <see cref="Logged"/> tells. On the session's thread.
    /// </summary>
    public uint LogStart
    {
        get
        {
            parts.Owner.ThrowIfForeign();
            return protocol.LogStart;
        }
    }

    /// <summary>
    /// What went over each link so far; of a host in the order in which its clients came. On the session's thread; see
    /// <see cref="PeerThread.Ask"/>.
    /// </summary>
    public IReadOnlyList<LinkTraffic> Links
    {
        get
        {
            parts.Owner.ThrowIfForeign();
            return protocol.Traffic;
        }
    }

    /// <summary>
    /// How many lines of the host's log this peer has, those included that were in the state it began from. On the session's thread.
    /// </summary>
    public uint LogLength
    {
        get
        {
            parts.Owner.ThrowIfForeign();
            return protocol.LogLength;
        }
    }

    /// <summary>
    /// What was counted; it goes on counting. On the session's thread: another gets a <see cref="SessionCounters.Copy"/>.
    /// </summary>
    public SessionCounters Counters => parts.Counters;

    /// <summary>Whether all peers with this strategy end up with the same world, bit for bit.</summary>
    public bool PromisesAgreement => parts.World.PromisesAgreement;

    /// <summary>The strategy that a thread warms up for before it steps this session; null for none.</summary>
    internal LateEventStrategy? WarmsUpFor => parts.Options.Warmup ? parts.Options.Strategy : null;

    /// <summary>What the session is put together of.</summary>
    internal SessionParts Parts => parts;

    /// <summary>A number that nobody can guess, for a host's session or a client's nonce. From any thread.</summary>
    public static ulong DrawNumber()
    {
        Span<byte> bytes = stackalloc byte[sizeof(ulong)];
        RandomNumberGenerator.Fill(bytes);
        return BinaryPrimitives.ReadUInt64LittleEndian(bytes);
    }

    /// <summary>
    /// Has a step that is simulating end soon, by an <see cref="OperationCanceledException"/>; from any thread. The world stands still from
    /// then on.
    /// </summary>
    internal void Interrupt() => parts.World.Interrupt();

    /// <summary>Says goodbye and ends the session. The world stays readable.</summary>
    /// <exception cref="InvalidOperationException">A <see cref="PeerThread"/> runs the session, and this is another thread.</exception>
    public void Leave()
    {
        parts.Owner.ThrowIfForeign();
        if (!parts.Status.HasEnded)
        {
            protocol.Farewell();
            parts.Status.End(SessionEnd.Left, "This peer left.");
        }
    }

    /// <summary>
    /// Does something to the shared world, now, or later by what <see cref="SessionOptions.Window"/> has of local lag for it: seen here
    /// then, by the others too or as soon as they hear of it.
    /// </summary>
    /// <returns>The stamped event; of a spawn, <see cref="ExternalEvent.Body"/> is the new body.</returns>
    /// <exception cref="InvalidOperationException">
    /// The session is not running; a <see cref="PeerThread"/> runs it, and this is another thread; or of a client's events
    /// <see cref="ClientSession.MaxUnconfirmedEvents"/> wait for the host's verdict, and nothing happened: it can be done again once
    /// verdicts have come.
    /// </exception>
    /// <exception cref="SceneException">
    /// A value may not enter the world, or this peer may not do that, or it is more than <see cref="SessionOptions.MaxGivenSpeed"/> or
    /// <see cref="SessionOptions.MaxSpawned"/> permits here; nothing happened.
    /// </exception>
    /// <exception cref="SimulationException">The world cannot be simulated with it; the session has ended.</exception>
    public ExternalEvent Do(in PlayerAction action)
    {
        parts.Owner.ThrowIfForeign();
        try
        {
            SimTime time = SharedTime.IsSet ? SharedTime.Now + parts.Options.Window.LocalLag(action.Kind) : SimTime.MinValue;
            return protocol.Do(action, time);
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            throw;
        }
    }

    /// <summary>
    /// Does what is due: takes in datagrams, sends, brings the world ahead, by a bounded number of events; see
    /// <see cref="LiveWorld.IsBehind"/>.
    /// </summary>
    /// <returns>How long until something is due again, unless a datagram or an action comes first.</returns>
    /// <remarks>
    /// A world that cannot be simulated any further ends the session, with the reason; whatever others send, it does not throw.
    /// </remarks>
    /// <exception cref="OperationCanceledException"><see cref="SessionOptions.Cancellation"/> asked for an end, and the session has not
    /// ended; <see cref="Leave"/> ends it.</exception>
    /// <exception cref="InvalidOperationException">A <see cref="PeerThread"/> runs the session, and this is another thread.</exception>
    public SimDuration Step()
    {
        parts.Owner.ThrowIfForeign();
        return loop.Step();
    }

    /// <summary>Ends the session, or asks for a fresh copy, because its world cannot be simulated any further.</summary>
    private protected void EndWorld(SimulationException failure) => loop.EndWorld(failure);
}
