using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Hosts;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The peer that others join. It alone accepts or refuses each event, once, and keeps the log of all verdicts in order.</summary>
/// <remarks>
/// Its clock is the session's. The watermark, before which it accepts nothing, follows that clock, so a silent client stalls no peer. It
/// can play itself, by <see cref="Session.Do"/>, or only serve. It keeps no state for a client that has not proved its address by a cookie.
/// </remarks>
public sealed class HostSession : Session
{
    private readonly HostProtocol host;
    private readonly HandlerList<Action<LinkTraffic>> clientCame;
    private readonly HandlerList<Action<LinkTraffic>> clientGone;
    private readonly HandlerList<Action<PlayerExpulsion>> playerExpelled;
    private readonly HandlerList<Action<byte, SimTime>> clientDiverged;
    private readonly HandlerList<Action<KeyRefusal>> keyRefused;

    /// <summary>Opens a session and waits for clients.</summary>
    /// <param name="scene">The scene that all peers share.</param>
    /// <param name="port">The carrier of datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="sessionId">
    /// A number that no other session on these machines has; choose it at random. From it and a secret of this host each join gets an
    /// unguessable session id, which every datagram carries, so that datagrams of a former client are not mistaken for those of a later
    /// one.
    /// </param>
    public HostSession(Scene scene, IDatagramPort port, IClock clock, HostOptions options, ulong sessionId)
        : this(new HostProtocol(
            new SessionParts(scene ?? throw new ArgumentNullException(nameof(scene)), port, clock, options, SessionState.Waiting),
            options,
            sessionId))
    {
    }

    /// <summary>Opens a session in real time.</summary>
    /// <param name="scene">The scene that all peers share.</param>
    /// <param name="port">The carrier of datagrams; not disposed with the session.</param>
    /// <param name="options">How to take part; null for the default.</param>
    /// <param name="isReachable">Whether others can reach it; if nothing protects it, the options must say that this is meant.</param>
    internal static HostSession Open(Scene scene, IDatagramPort port, HostOptions? options, bool isReachable)
    {
        options ??= new HostOptions();
        if (isReachable)
        {
            options.ThrowIfUnprotectedUnawares();
        }

        return new HostSession(scene, port, new StopwatchClock(), options, DrawNumber());
    }

    private HostSession(HostProtocol host)
        : base(host.Parts, host)
    {
        this.host = host;
        clientCame = new(host.Parts.Owner);
        clientGone = new(host.Parts.Owner);
        playerExpelled = new(host.Parts.Owner);
        clientDiverged = new(host.Parts.Owner);
        keyRefused = new(host.Parts.Owner);
        host.Handshake.WrongKeys.Refused += refusal => keyRefused.Raise(refusal, static (handler, told) => handler(told));
        host.Handshake.Seating.Came += link => clientCame.Raise(link, static (handler, told) => handler(told));
        host.Roster.Gone += link => clientGone.Raise(link, static (handler, told) => handler(told));
        host.Enforcer.Expelled += expulsion => playerExpelled.Raise(expulsion, static (handler, told) => handler(told));
        host.DesyncReport.Diverged += (peer, time) =>
            clientDiverged.Raise((peer, time), static (handler, told) => handler(told.peer, told.time));
    }

    /// <summary>Raised on the session's thread for each client that has its snapshot and got its number, with its link.</summary>
    public event Action<LinkTraffic>? ClientCame
    {
        add => clientCame.Add(value);
        remove => clientCame.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread, once, for each client that left, fell silent, was disconnected, or joined again from the same
    /// address, with the total traffic of its link. Not raised for clients that are there when the session ends.
    /// </summary>
    public event Action<LinkTraffic>? ClientGone
    {
        add => clientGone.Add(value);
        remove => clientGone.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread when a player is expelled because its actions cost more than <see cref="HostOptions.PlayerBudget"/>,
    /// with the cost and the removed bodies. <see cref="ClientGone"/> is raised too.
    /// </summary>
    public event Action<PlayerExpulsion>? PlayerExpelled
    {
        add => playerExpelled.Add(value);
        remove => playerExpelled.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread, once for each client that reports that its committed state at that time differs from this host's.
    /// </summary>
    public event Action<byte, SimTime>? ClientDiverged
    {
        add => clientDiverged.Add(value);
        remove => clientDiverged.Remove(value);
    }

    /// <summary>
    /// Raised on the session's thread for each client that shows a wrong connect key, ten a second at most after the first hundred: after five
    /// wrong ones from one machine none from there is looked at for a second, then for twice as long each time, up to 64 s.
    /// </summary>
    public event Action<KeyRefusal>? KeyRefused
    {
        add => keyRefused.Add(value);
        remove => keyRefused.Remove(value);
    }

    /// <summary>The number of clients that are in, without those still joining. On the session's thread.</summary>
    public int ClientCount
    {
        get
        {
            host.Parts.Owner.ThrowIfForeign();
            return host.Roster.SeatedCount;
        }
    }

    /// <summary>
    /// The time before which nothing changes any more: the history before the clock, or before where the world stands if that is behind; earlier,
    /// by up to <see cref="HostOptions.LongestHistory"/>, while a player's events are on their way. It never goes back. With
    /// <see cref="HostOptions.ConfirmsEarly"/> it is later, as far as the players have promised.
    /// </summary>
    /// <remarks>While a host is stuck, what it has not simulated can still be changed, above all by removing what it is stuck on.</remarks>
    public SimTime Watermark => host.Watermark.Now;

    /// <summary>
    /// The cost of the players' actions so far, by ascending number, for those that were charged anything. On the session's thread.
    /// </summary>
    public IReadOnlyList<PlayerCost> Costs
    {
        get
        {
            host.Parts.Owner.ThrowIfForeign();
            return host.Enforcer.Costs;
        }
    }

    /// <summary>The number of log entries kept: those not settled, and those that some client has not acknowledged.</summary>
    internal int KeptLogEntries => host.Log.Lines.Kept;

    /// <summary>The number of clients still joining.</summary>
    internal int ComingCount => host.Roster.All.Count - host.Roster.SeatedCount;

    /// <summary>
    /// What the connect token of a player says of it: name, identity, rights. Null for one without a token, and for a number that nobody
    /// has now: keep what it was when the player came.
    /// </summary>
    /// <remarks>On the session's thread.</remarks>
    /// <param name="player">The player's number.</param>
    /// <exception cref="ArgumentOutOfRangeException">It is no client's number: neither a player's nor a spectator's.</exception>
    public PlayerAdmission? AdmissionOf(byte player)
    {
        host.Parts.Owner.ThrowIfForeign();
        ThrowIfNoClient(player);
        return host.Roster.AdmissionOf(player);
    }

    /// <summary>
    /// Sends an update to every client on the next step instead of at the keep-alive, so that they learn sooner what is committed.
    /// </summary>
    /// <remarks>On the session's thread.</remarks>
    public void Flush()
    {
        host.Parts.Owner.ThrowIfForeign();
        host.Flush();
    }

    /// <summary>Sends a player away. It is notified, and its session ends.</summary>
    /// <remarks>
    /// Its number becomes free and its pass void; it may join again as a new player. Its actions and spawned bodies stay: see
    /// <see cref="RemoveBodiesOf"/>. On the session's thread.
    /// </remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>False if no client has that number now.</returns>
    /// <exception cref="ArgumentOutOfRangeException">It is no client's number: neither a player's nor a spectator's.</exception>
    public bool Kick(byte player)
    {
        host.Parts.Owner.ThrowIfForeign();
        ThrowIfNoClient(player);
        return host.Roster.Kick(j => j.Peer == player) > 0;
    }

    /// <summary>
    /// Sends a player away, as <see cref="Kick"/> does, and does not let it in again for as long as this session lasts. If a connect token or
    /// a player's key proves who it is, that player is shut out and nobody else. Otherwise all players from its machine are sent away, and
    /// everyone who shares it is shut out, also with a token or a key. A machine is an IP address, of IPv6 its first 64 bits.
    /// </summary>
    /// <remarks>On the session's thread.</remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>The machine, for <see cref="Unban"/>; null if no client has that number now.</returns>
    /// <exception cref="ArgumentOutOfRangeException">It is no client's number: neither a player's nor a spectator's.</exception>
    public PeerAddress? Ban(byte player)
    {
        host.Parts.Owner.ThrowIfForeign();
        ThrowIfNoClient(player);
        if (host.Roster.Seated(player) is not Client found)
        {
            return null;
        }

        PeerAddress machine = found.Link.Other.Machine;
        KnownPlayer who = host.Roster.KnownOf(found);
        host.Handshake.BanList.ShutOut(who, machine);
        host.Roster.Kick(j => j == found || (!who.IsProven && j.Link.Other.Machine == machine));
        return machine;
    }

    /// <summary>
    /// Lets players in again from a machine: the machine itself, and all players who were sent away from it, banned or shut out for a while because
    /// they cost too much, wherever they come from now.
    /// </summary>
    /// <param name="machine">The result of <see cref="Ban"/>, or any address of the machine.</param>
    /// <returns>False if nobody was shut out there.</returns>
    /// <remarks>On the session's thread.</remarks>
    public bool Unban(PeerAddress machine)
    {
        host.Parts.Owner.ThrowIfForeign();
        return host.Handshake.BanList.LetInAgain(machine.Machine, host.Parts.Clock.Now);
    }

    /// <summary>Removes all bodies that were spawned under a player's number, whether or not a client has it now.</summary>
    /// <remarks>
    /// The removals are events of this host, so all peers see them at the same simulated time: now, or where the world stands if that is
    /// behind, or at its spawn for a body whose spawn is still to come. On the session's thread. Cost: one removal for each body.
    /// </remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>The number of bodies removed.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The number is not from 1 to <see cref="SessionOptions.MaxClients"/>.</exception>
    /// <exception cref="InvalidOperationException">The session is not running.</exception>
    public int RemoveBodiesOf(byte player)
    {
        host.Parts.Owner.ThrowIfForeign();
        ThrowIfNoPlayer(player);
        if (World is not LiveWorld world || State != SessionState.Running)
        {
            throw new InvalidOperationException($"Nothing can be removed while the session is {State}.");
        }

        SimTime now = SharedTime.Now + host.Parts.Options.Window.LocalLag(EventKind.Remove);
        try
        {
            return host.Removal.RemoveSpawned(null, player, world.IsBehind ? SimTime.Min(now, world.Simulation.SimulatedTo) : now);
        }
        catch (SimulationException failure)
        {
            EndWorld(failure);
            throw;
        }
    }

    private static void ThrowIfNoClient(byte number)
    {
        if (number is 0 or > SessionOptions.MaxNumber)
        {
            throw new ArgumentOutOfRangeException(
                "player",
                number,
                $"A client's number is 1 to {SessionOptions.MaxNumber}; spectators have those from {SessionOptions.MaxClients + 1} on.");
        }
    }

    private static void ThrowIfNoPlayer(byte player)
    {
        if (player is 0 or > SessionOptions.MaxClients)
        {
            throw new ArgumentOutOfRangeException(nameof(player), player, $"A player's number is 1 to {SessionOptions.MaxClients}.");
        }
    }
}
