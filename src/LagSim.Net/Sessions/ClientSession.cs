using System;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A peer that joins a host's session, at its start or at any later time.</summary>
/// <remarks>
/// It sets its clock by the host's before its first tick, and downloads the scene and the committed state. Its own events show at once; one
/// that the host refuses is retracted. If it loses its host, or its world turns out to be wrong, it asks to be let in again as the same
/// player, and continues from a fresh snapshot (<see cref="SessionState.Rejoining"/>). Its address may change at any time.
/// </remarks>
public sealed class ClientSession : Session
{
    /// <summary>
    /// The number of own events that can wait for the host's verdict, after which <see cref="Session.Do"/> throws: 16,384. At the default
    /// rate that a host processes, that is more than half a minute without an answer.
    /// </summary>
    public const int MaxUnconfirmedEvents = 1 << 14;

    private readonly ClientProtocol client;
    private readonly HandlerList<Action<string>> interrupted;
    private readonly HandlerList<Action<PlayerPass>> passGiven;
    private readonly HandlerList<Action> hostKeyChanged;
    private readonly HandlerList<Action> regained;
    private readonly HandlerList<Action<Divergence>> diverged;

    /// <summary>Creates a client that asks to be let in, from its first step on.</summary>
    /// <param name="scene">The scene that the host is expected to have; null accepts any.</param>
    /// <param name="port">The carrier of datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="host">The host's address.</param>
    /// <param name="nonce">A random number; an answer must carry it.</param>
    public ClientSession(Scene? scene, IDatagramPort port, IClock clock, ClientOptions options, PeerAddress host, ulong nonce)
        : this(new ClientProtocol(new SessionParts(scene, port, clock, options, SessionState.Joining), options, host, nonce))
    {
    }

    private ClientSession(ClientProtocol client)
        : base(client.Parts, client)
    {
        this.client = client;
        interrupted = new(client.Parts.Owner);
        passGiven = new(client.Parts.Owner);
        hostKeyChanged = new(client.Parts.Owner);
        regained = new(client.Parts.Owner);
        diverged = new(client.Parts.Owner);
        client.Loss.Interrupted += why => interrupted.Raise(why, static (handler, told) => handler(told));
        client.Seat.PassGiven += pass => passGiven.Raise(pass, static (handler, told) => handler(told));
        client.Requests.HostKeyChanged += () => hostKeyChanged.Raise(0, static (handler, _) => handler());
        client.Loss.Regained += () => regained.Raise(0, static (handler, _) => handler());
        client.Finder.Found += found => diverged.Raise(found, static (handler, told) => handler(told));
    }

    /// <summary>
    /// Raised on the session's thread when this peer has lost its host or its world and asks to be let in again, with the reason.
    /// <see cref="Session.Renewed"/> follows, or <see cref="Regained"/>, or the session ends.
    /// </summary>
    public event Action<string>? Interrupted
    {
        add => interrupted.Add(value);
        remove => interrupted.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread each time that the host gives this peer a number, with its <see cref="Pass"/>. That is before there
    /// is a world, so a program that saves the pass at once can come back even if it is killed.
    /// </summary>
    public event Action<PlayerPass>? PassGiven
    {
        add => passGiven.Add(value);
        remove => passGiven.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread when the host has proved itself by the key that this peer was given, and said that it has another one
    /// from now on, for which that one vouches. Remember the new fingerprint, <c>SecureClient.Host</c>, in place of the one that was given:
    /// the host does not answer to the former key for ever.
    /// </summary>
    /// <remarks>
    /// While it joins, before there is a world, or each time that it joins again; once for each change. Never in a session without protection.
    /// </remarks>
    public event Action? HostKeyChanged
    {
        add => hostKeyChanged.Add(value);
        remove => hostKeyChanged.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread when a silent host answers again before it has disconnected this peer; the session continues.
    /// </summary>
    public event Action? Regained
    {
        add => regained.Add(value);
        remove => regained.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread, once, when the cause of the first differing committed state is known, or known to be out of reach.
    /// </summary>
    public event Action<Divergence>? Diverged
    {
        add => diverged.Add(value);
        remove => diverged.Remove(value);
    }

    /// <summary>
    /// The first committed state that differed from the host's, with what is known about it so far; null while there is none. From any
    /// thread.
    /// </summary>
    public Divergence? Divergence => client.Finder.First;

    /// <summary>How late the host accepts an event in any case, as announced by the host; zero before that.</summary>
    public SimDuration History => client.Connection.History;

    /// <summary>
    /// How late at the most, while players' events are on their way (<see cref="HostOptions.LongestHistory"/>), as announced by the host;
    /// zero before that.
    /// </summary>
    public SimDuration LongestHistory => client.Connection.LongestHistory;

    /// <summary>What the host's refusal says that ended the session; null if none did. From any thread, as
    /// <see cref="Session.EndReason"/>.</summary>
    internal RefusalReason? RefusedFor => client.Parts.Status.RefusedFor;

    /// <summary>The host's address: the one that answered, if it was asked at several. On the session's thread.</summary>
    internal PeerAddress HostAddress => client.Connection.Host;

    /// <summary>The estimate of the offset between the two clocks.</summary>
    internal ClockSync ClockSync => client.Seat.Clock;

    /// <summary>
    /// Proves to a host that this is the same player, for another session of this program: see <see cref="ClientOptions.Pass"/>. Null
    /// before the host gave a number. From any thread.
    /// </summary>
    public PlayerPass? Pass => client.Seat.Pass;

    /// <summary>
    /// Whether the host is to keep this player's number when it leaves, by <see cref="Session.Leave"/> or with its
    /// <see cref="PeerThread"/>, as it does for one that fell silent: who comes back with <see cref="Pass"/> is the same player. Default
    /// false: it gives up number and pass. Set it before it leaves; from any thread.
    /// </summary>
    /// <remarks>
    /// The host keeps it for its <see cref="SessionOptions.RejoinTime"/>, or until no other is left for a newcomer. A session that fails
    /// leaves as if this were set.
    /// </remarks>
    public bool KeepsPlace
    {
        get => client.Connection.KeepsPlace;
        set => client.Connection.KeepsPlace = value;
    }

    /// <summary>
    /// The number of own events that wait for the host's verdict, at most <see cref="MaxUnconfirmedEvents"/>. On the session's thread.
    /// </summary>
    public int UnconfirmedEvents
    {
        get
        {
            client.Parts.Owner.ThrowIfForeign();
            return client.Connection.Unconfirmed.Count;
        }
    }
}
