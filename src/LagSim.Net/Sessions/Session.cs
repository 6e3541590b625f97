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
/// One peer's part in a shared world: it exchanges datagrams over a port, keeps the shared time, and simulates a world ahead of it.
/// </summary>
/// <remarks>
/// <para>For one thread, in real time (<see cref="PeerThread"/> provides one) or in virtual time, where the harness steps it. Safe to read
/// from any thread: <see cref="Scene"/>, <see cref="SharedTime"/>, <see cref="State"/>, <see cref="EndReason"/>, <see cref="Committed"/>,
/// and the reference <see cref="World"/>; of the world itself only its render snapshots, its counts of late steps, and its start.</para>
/// <para>While a <see cref="PeerThread"/> runs the session, members for the session's thread throw an
/// <see cref="InvalidOperationException"/> on any other, but for <see cref="Counters"/> and what is reached through
/// <see cref="World"/>, which are not checked. An exception from a handler then ends nothing, and
/// <see cref="HandlerFailed"/> reports it; without such a thread it propagates to the caller of <see cref="Step"/>, or of
/// whatever member raised the event.</para>
/// </remarks>
public abstract class Session
{
    /// <summary>The version of the wire format. Peers of different versions refuse each other with that reason.</summary>
    public const byte WireVersion = WireFormat.Version;

    private readonly SessionParts parts;
    private readonly ISessionProtocol protocol;
    private readonly SessionLoop loop;
    private readonly CancellationTokenRegistration watch;
    private bool hasWarned;
    private readonly HandlerList<Action> begun;
    private readonly HandlerList<Action<string>> renewed;
    private readonly HandlerList<Action> ended;
    private readonly HandlerList<Action<LogEntry>> logged;
    private readonly HandlerList<Action<CommittedState>> stateCommitted;
    private readonly HandlerList<Action<RosterChange>> rosterChanged;

    private protected Session(SessionParts parts, ISessionProtocol protocol)
    {
        begun = new(parts.Owner);
        renewed = new(parts.Owner);
        ended = new(parts.Owner);
        logged = new(parts.Owner);
        stateCommitted = new(parts.Owner);
        rosterChanged = new(parts.Owner);
        this.parts = parts;
        this.protocol = protocol;
        loop = new SessionLoop(parts, protocol);
        watch = parts.Options.Cancellation.Register(static session => ((Session)session!).Interrupt(), this);
        parts.Status.Ended += () => watch.Dispose(); // a long-lived token would otherwise keep every session alive
        parts.Status.Ended += parts.World.Watchdog.Dispose;
        parts.Start.Begun += () => begun.Raise(0, static (handler, _) => handler());
        parts.Start.Renewed += why => renewed.Raise(why, static (handler, told) => handler(told));
        parts.Status.Ended += () => ended.Raise(0, static (handler, _) => handler());
        parts.Journal.Told += entry => logged.Raise(entry, static (handler, told) => handler(told));
        parts.Peers.Changed += change => rosterChanged.Raise(change, static (handler, told) => handler(told));
        parts.Commits.Committed += state => stateCommitted.Raise(state, static (handler, told) => handler(told));
    }

    /// <summary>Raised on the session's thread, once, when <see cref="World"/> exists and nothing has happened in it yet.</summary>
    public event Action? Begun
    {
        add => begun.Add(value);
        remove => begun.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread each time that a fresh snapshot replaces <see cref="World"/>, which is a different object from then
    /// on, with the reason. The new world lacks this peer's actions that the host had not validated.
    /// </summary>
    public event Action<string>? Renewed
    {
        add => renewed.Add(value);
        remove => renewed.Remove(value);
    }

    /// <summary>Raised on the thread that ended the session, once; <see cref="EndReason"/> says why.</summary>
    public event Action? Ended
    {
        add => ended.Add(value);
        remove => ended.Remove(value);
    }

    /// <summary>Raised on the session's thread for every log entry, in order, once it has taken effect here.</summary>
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

    /// <summary>
    /// Raised on the session's thread for every change of <see cref="Roster"/>, once it shows it: first those who are gone.
    /// </summary>
    /// <remarks>The host itself is in the roster from the beginning; a client is told of it, and of itself, like of all others.</remarks>
    public event Action<RosterChange>? RosterChanged
    {
        add => rosterChanged.Add(value);
        remove => rosterChanged.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread with the exception that a handler of one of the session's events threw, while a
    /// <see cref="PeerThread"/> runs it. The other handlers are still called, and nothing ends.
    /// </summary>
    /// <remarks>
    /// Without a handler the exception is written to <see cref="System.Diagnostics.Trace"/>, and so is one that a handler of this event
    /// throws. While the thread ends, the event may be raised on the thread that disposes it.
    /// </remarks>
    public event Action<Exception>? HandlerFailed
    {
        add => parts.Owner.Failures.Failed += value;
        remove => parts.Owner.Failures.Failed -= value;
    }

    /// <summary>
    /// Whether every datagram is encrypted and authenticated: the options have a protection. If not, anyone on the path can read, change
    /// and forge what is sent. From any thread.
    /// </summary>
    public bool IsProtected => parts.Options.IsProtected;

    /// <summary>The scene that all peers share; null for a client that has not received it. From any thread.</summary>
    public Scene? Scene => parts.World.Scene;

    /// <summary>The session's time; readable once <see cref="SharedClock.IsSet"/>, from any thread.</summary>
    public SharedClock SharedTime => parts.SharedTime;

    /// <summary>
    /// How far behind the shared time this peer shows the world: <see cref="SessionOptions.DisplayDelay"/> with <c>interpolation</c>, else
    /// zero. From any thread.
    /// </summary>
    public SimDuration DisplayDelay => parts.World.DisplayDelay;

    /// <summary>
    /// The time at which to read a render snapshot for a frame drawn now: shared time less <see cref="DisplayDelay"/>. From any thread,
    /// once there is a <see cref="World"/>.
    /// </summary>
    /// <remarks>
    /// At first, while that lies before this peer's world, it is the earliest instant of that world, which therefore stands still until it
    /// can be shown in motion.
    /// </remarks>
    public SimTime DisplayTime => parts.World.DisplayTime;

    /// <summary>The state of the session. From any thread.</summary>
    public SessionState State => parts.Status.State;

    /// <summary>
    /// Why the session ended, as a sentence; null until then. From any thread: it is set once <see cref="State"/> says that the session
    /// ended.
    /// </summary>
    public string? EndReason => parts.Status.EndReason;

    /// <summary>
    /// Why the session does not run, as a sentence: what it waits for, such as no answer from the host for 5 s, or
    /// <see cref="EndReason"/>; null while it runs. From any thread, as of the last step.
    /// </summary>
    public string? WhyNotRunning => parts.Status.WhyNotRunning;

    /// <summary>The cause of the session's end. From any thread, as <see cref="EndReason"/>.</summary>
    public SessionEnd EndedBy => parts.Status.EndedBy;

    /// <summary>
    /// The exception that ended the world, or the thread, and with it the session; null if it goes on, or ended for another reason. From any
    /// thread, as <see cref="EndReason"/>. What a game's own code threw (its rules, its accelerations) is an inner exception of it, with
    /// the stack.
    /// </summary>
    public Exception? Failure => parts.Status.Failure;

    /// <summary>As what this peer takes part: <see cref="SessionOptions.Role"/>. From any thread.</summary>
    public PeerRole Role => parts.Options.Role;

    /// <summary>This peer's number; 0 is the host. Meaningful once joined.</summary>
    public byte Peer => parts.Self.Number;

    /// <summary>
    /// Who is in the session, by ascending number, the host and this peer included; empty for a client that has not heard of it. From any
    /// thread: the list never changes, another replaces it.
    /// </summary>
    /// <remarks>
    /// The host decides who is in, and whatever is lost reaches every peer in the end. A peer that leaves, or is silent for the
    /// <see cref="SessionOptions.Timeout"/>, is not in it any more. After the session's end it stays as it was.
    /// </remarks>
    public IReadOnlyList<RosterMember> Roster => parts.Peers.Members;

    /// <summary>
    /// The world, once its start is known. It stays the same object, except for a client that gets a fresh snapshot
    /// (<see cref="Renewed"/>). From any thread, but see the remarks for its members.
    /// </summary>
    public LiveWorld? World => parts.World.Live;

    /// <summary>
    /// The snapshot that the world began from, for a client that joined late; null if it began with the scene. On the session's thread.
    /// </summary>
    public WorldSnapshot? BegunFrom
    {
        get
        {
            parts.Owner.ThrowIfForeign();
            return parts.World.BegunFrom;
        }
    }

    /// <summary>
    /// How far ahead of the shared time an action can be scheduled: half of the history of <see cref="SessionOptions.Window"/>. From any
    /// thread.
    /// </summary>
    /// <remarks>A host refuses what is more than its history ahead of its own clock. The other half is for clocks that are off.</remarks>
    public SimDuration MaxAhead => parts.Options.Window.History / 2;

    /// <summary>The newest committed state; null before there is one. From any thread.</summary>
    public CommittedState? Committed => parts.Commits.Newest;

    /// <summary>
    /// The number of entries of the host's log that this peer was not sent, because <see cref="BegunFrom"/> includes every accepted event
    /// in them; <see cref="Logged"/> begins with the next. On the session's thread.
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
    /// The traffic over each link so far; for a host in the order in which its clients came. On the session's thread; see
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
    /// The number of entries of the host's log that this peer has, including those in its initial state. On the session's thread.
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
    /// The live counters, which keep changing. On the session's thread; another thread takes a <see cref="SessionCounters.Copy"/>.
    /// </summary>
    public SessionCounters Counters => parts.Counters;

    /// <summary>Whether all peers with this strategy end up with the same world, bit for bit.</summary>
    public bool PromisesAgreement => parts.World.PromisesAgreement;

    /// <summary>The strategy to warm up for before this session is stepped; null for none.</summary>
    internal LateEventStrategy? WarmsUpFor => parts.Options.Warmup ? parts.Options.Strategy : null;

    /// <summary>The parts of the session.</summary>
    internal SessionParts Parts => parts;

    /// <summary>Draws an unguessable number, for a host's session or a client's nonce. From any thread.</summary>
    public static ulong DrawNumber()
    {
        Span<byte> bytes = stackalloc byte[sizeof(ulong)];
        RandomNumberGenerator.Fill(bytes);
        return BinaryPrimitives.ReadUInt64LittleEndian(bytes);
    }

    /// <summary>
    /// Makes a running simulation step end soon, by an <see cref="OperationCanceledException"/>; from any thread. The world stops for good.
    /// </summary>
    internal void Interrupt() => parts.World.Interrupt();

    /// <summary>Says goodbye and ends the session. The world stays readable.</summary>
    /// <exception cref="InvalidOperationException">A <see cref="PeerThread"/> runs the session, and this is another thread.</exception>
    public void Leave()
    {
        parts.Owner.ThrowIfForeign();
        if (!parts.Status.HasEnded)
        {
            protocol.Farewell(null);
            parts.Status.End(SessionEnd.Left, "This peer left.");
        }
    }

    /// <summary>Says goodbye and ends the session because an exception ended its thread. What it says is nobody else's affair.</summary>
    internal void Fail(Exception fault)
    {
        if (!parts.Status.HasEnded)
        {
            protocol.Farewell("An exception ended its session.");
            parts.Status.End(SessionEnd.Failed, $"An exception ended the session's thread. {fault.Message}", fault);
        }
    }

    /// <summary>
    /// Performs an action in the shared world, now or later by the local lag of <see cref="SessionOptions.Window"/>, or at a future instant.
    /// This peer sees it at that time, and the others do too, or as soon as it reaches them.
    /// </summary>
    /// <param name="action">The action.</param>
    /// <param name="at">When, in shared time, whatever the local lag: from <see cref="SharedTime"/> now up to <see cref="MaxAhead"/> later. The
    /// event is stamped with that instant and goes out at once, so peers that have it by then need not heal it.</param>
    /// <returns>The stamped event; for a spawn, <see cref="ExternalEvent.Body"/> is the new body.</returns>
    /// <exception cref="InvalidOperationException">
    /// The session is not running; or a <see cref="PeerThread"/> runs it, and this is another thread; or
    /// <see cref="ClientSession.MaxUnconfirmedEvents"/> events of a client wait for the host's verdict. Nothing happened; in the last case,
    /// try again once verdicts have arrived.
    /// </exception>
    /// <exception cref="ArgumentOutOfRangeException">The instant has passed, or is too far ahead; nothing happened.</exception>
    /// <exception cref="SceneException">
    /// A value may not enter the world, or this peer is a spectator or may not do that for another reason, or it exceeds this peer's
    /// <see cref="SessionOptions.MaxGivenSpeed"/> or <see cref="SessionOptions.MaxSpawned"/>; nothing happened.
    /// </exception>
    /// <exception cref="SimulationException">The world cannot be simulated with the action; the session has ended.</exception>
    public ExternalEvent Do(in PlayerAction action, SimTime? at = null)
    {
        parts.Owner.ThrowIfForeign();
        if (Role == PeerRole.Spectator)
        {
            throw new SceneException(
                $"{action.Kind} is not for a spectator, which only watches; join as a player (SessionOptions.Role) to do something.");
        }

        SimTime now = SharedTime.IsSet ? SharedTime.Now : SimTime.MinValue;
        if (at is SimTime asked && SharedTime.IsSet && (asked < now || asked > now + MaxAhead))
        {
            throw new ArgumentOutOfRangeException(
                nameof(at), asked.ToShortString(), $"An action can be done from now, {now.ToShortString()}, to {MaxAhead.ToShortString()} later, half"
                    + " of the history of the window.");
        }

        try
        {
            return protocol.Do(action, at ?? (SharedTime.IsSet ? now + parts.Options.Window.LocalLag(action.Kind) : now));
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            throw;
        }
    }

    /// <summary>
    /// Does what is due: receives and sends datagrams, and advances the world by a bounded number of events; see
    /// <see cref="LiveWorld.IsBehind"/>.
    /// </summary>
    /// <returns>How long until something is due again, unless a datagram or an action comes first.</returns>
    /// <remarks>
    /// A world that cannot be simulated any further ends the session, with the reason. Nothing that other peers send makes this throw.
    /// </remarks>
    /// <exception cref="OperationCanceledException">
    /// <see cref="SessionOptions.Cancellation"/> was cancelled, and the session has not ended; <see cref="Leave"/> ends it.
    /// </exception>
    /// <exception cref="InvalidOperationException">A <see cref="PeerThread"/> runs the session, and this is another thread.</exception>
    public SimDuration Step()
    {
        parts.Owner.ThrowIfForeign();
        WarnOnceIfUnprotected();
        return loop.Step();
    }

    /// <summary>Wipes the keys of all links if the session has ended. Nothing can be sent over them any more.</summary>
    internal void WipeKeysIfEnded()
    {
        if (State == SessionState.Ended)
        {
            protocol.WipeKeys();
        }
    }

    /// <summary>
    /// Ends the session for a thread that never comes back from its world; for the thread that takes its place. Other peers need not wait
    /// for the timeout.
    /// </summary>
    internal void EndLostWorld(SimulationException failure) => loop.EndWorld(failure);

    /// <summary>Says in <see cref="System.Diagnostics.Trace"/>, at the first step, that a session is not protected.</summary>
    private void WarnOnceIfUnprotected()
    {
        if (!hasWarned && !IsProtected)
        {
            HandlerFailures.Write(
                "This session is not protected: anyone on the path can read it, act in any player's name, and be its host. Give its"
                    + " options a protection, such as that of the package LagSim.Net.Secure.");
        }

        hasWarned = true;
    }

    /// <summary>Ends the session, or asks for a fresh snapshot, because its world cannot be simulated any further.</summary>
    private protected void EndWorld(SimulationException failure) => loop.EndWorld(failure);
}
