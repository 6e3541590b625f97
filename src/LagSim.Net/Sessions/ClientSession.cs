using System;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Clients;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A peer that joins a host's session, at its start or at any time later.</summary>
/// <remarks>
/// It sets its clock by the host's before its first tick, and fetches scene and committed state from it. Its own events show at once; one
/// that the host refuses is taken back. When it loses its host, or its world turns out to be wrong, it asks by itself to be let in again,
/// as the same player, and goes on from a fresh copy (<see cref="SessionState.Rejoining"/>). Its address may change at any time.
/// </remarks>
public sealed class ClientSession : Session
{
    /// <summary>
    /// So many own events can wait for the host's verdict; <see cref="Session.Do"/> throws while they do. 16,384: at the rate that a host
    /// takes by default, more than half a minute without an answer.
    /// </summary>
    public const int MaxUnconfirmedEvents = 1 << 14;

    private readonly ClientProtocol client;
    private readonly HandlerList<Action<string>> interrupted;
    private readonly HandlerList<Action<PlayerPass>> passGiven;
    private readonly HandlerList<Action> regained;
    private readonly HandlerList<Action<Divergence>> diverged;

    /// <summary>Asks to be let in, from the first step on.</summary>
    /// <param name="scene">The scene that the host is expected to have; null takes the host's, whichever it is.</param>
    /// <param name="port">What carries datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's own clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="host">Where the host is.</param>
    /// <param name="nonce">A number chosen at random; an answer must bear it.</param>
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
        regained = new(client.Parts.Owner);
        diverged = new(client.Parts.Owner);
        client.Loss.Interrupted += why => interrupted.Raise(why, static (handler, told) => handler(told));
        client.Seat.PassGiven += pass => passGiven.Raise(pass, static (handler, told) => handler(told));
        client.Loss.Regained += () => regained.Raise(0, static (handler, _) => handler());
        client.Finder.Found += found => diverged.Raise(found, static (handler, told) => handler(told));
    }

    /// <summary>
    /// Raised on the session's thread when this peer lost its host, or its world, and asks to be let in again: with why.
    /// <see cref="Session.Renewed"/> follows, or <see cref="Regained"/>, or the session ends.
    /// </summary>
    public event Action<string>? Interrupted
    {
        add => interrupted.Add(value);
        remove => interrupted.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread each time that the host gives this peer a number, with what shows that it is this player:
    /// <see cref="Pass"/>. That is before there is a world, so a program that keeps it at once can come back whenever it is killed.
    /// </summary>
    public event Action<PlayerPass>? PassGiven
    {
        add => passGiven.Add(value);
        remove => passGiven.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread when a host that had fallen silent was heard again before it disconnected this peer: all goes on.
    /// </summary>
    public event Action? Regained
    {
        add => regained.Add(value);
        remove => regained.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread, once, when it is found out what the first differing committed state comes from, or that this cannot
    /// be.
    /// </summary>
    public event Action<Divergence>? Diverged
    {
        add => diverged.Add(value);
        remove => diverged.Remove(value);
    }

    /// <summary>
    /// The first committed state that was not the host's, and what is known of it by now; null while there is none. From any thread.
    /// </summary>
    public Divergence? Divergence => client.Finder.First;

    /// <summary>How late the host accepts an event, as it said; zero before it has.</summary>
    public SimDuration History => client.Connection.History;

    /// <summary>What is known of the distance between the two clocks.</summary>
    internal ClockSync ClockSync => client.Seat.Clock;

    /// <summary>
    /// What shows a host that this is the player it was, for another session of this program: see <see cref="ClientOptions.Pass"/>. Null
    /// before the host gave a number. From any thread.
    /// </summary>
    public PlayerPass? Pass => client.Seat.Pass;

    /// <summary>
    /// How many own events wait for the host's verdict, at most <see cref="MaxUnconfirmedEvents"/>. On the session's thread.
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
