using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The host side of the session protocol: routes each datagram to the part that handles it, and lets each part do what is due.
/// </summary>
internal sealed class HostProtocol : ISessionProtocol
{
    private readonly HostOptions options;
    private readonly ClientTimeouts timeouts;
    private readonly ClientEvents events;
    private readonly HostActions actions;
    private readonly LogBroadcast broadcast;
    private readonly RosterBroadcast peers;
    private readonly PlayerAnnouncer players;

    /// <exception cref="SceneException">The scene is too large to be shared.</exception>
    internal HostProtocol(SessionParts parts, HostOptions options, ulong sessionId)
    {
        Parts = parts;
        this.options = options;
        SimTime now = parts.Clock.Now;
        PlayerPlaces places = new(options, now, parts.World.Scene, sessionId);
        Roster = new ClientRoster(places, parts.Sender, parts.Clock);
        Watermark = new Watermark(parts.SharedTime, parts.World, options, Roster);
        Log = new AuthoritativeLog(parts.World, Watermark, parts.Journal, parts.Counters, parts.Clock);
        broadcast = new LogBroadcast(Roster, Log, Watermark, parts.World, parts.Commits, parts.KeepAlive, parts.Sender, parts.Clock);
        Log.Recorded += broadcast.NoteRecorded;
        WorkBudget budget = new(parts.World, parts.SharedTime, options.PlayerBudget);
        timeouts = new ClientTimeouts(Roster, Log.Lines, options.Timeout, options.JoinLimits.SlowestDownload, now);
        Handshake = new JoinHandshake(parts, options, sessionId, Roster, places, Log, budget, timeouts, Watermark);
        peers = new RosterBroadcast(Roster, places, timeouts, parts);
        Handshake.Seating.Came += _ => peers.Refresh();
        Roster.Gone += _ => peers.Refresh();
        RecentTouches acts = new(options.PlayerBudget is not null, 10 * options.MaxEventsPerSecond);
        EventValidator validator = new(places, parts.World, parts.SharedTime, Watermark, budget, parts.Journal, options.Window.History);
        events = new ClientEvents(places, validator, parts.World, parts.SharedTime, acts, Log, parts.Counters);
        actions = new HostActions(parts.Actions, Log);
        players = new PlayerAnnouncer(Roster, places, timeouts, actions, parts);
        Removal = new BodyRemoval(parts.World, actions, Watermark);
        Enforcer = new BudgetEnforcer(budget, acts, Roster, Handshake.BanList, Removal, actions, parts.World, Watermark, parts.Status);
        DesyncReport = new DesyncReporter(Roster, parts.Journal, parts.World, Watermark, parts.Sender, parts.Counters, parts.Clock);
        parts.SharedTime.Adjust(SimDuration.Zero);
        peers.Refresh();
    }

    public IReadOnlyList<LinkTraffic> Traffic => Roster.All.FindAll(j => j.Peer > 0).ConvertAll(j => j.Link.Traffic);

    public uint LogLength => Log.Lines.Count;

    public uint LogStart => 0;

    internal SessionParts Parts { get; }

    internal ClientRoster Roster { get; }

    internal Watermark Watermark { get; }

    internal AuthoritativeLog Log { get; }

    internal JoinHandshake Handshake { get; }

    internal BudgetEnforcer Enforcer { get; }

    internal BodyRemoval Removal { get; }

    internal DesyncReporter DesyncReport { get; }

    public ExternalEvent Do(in PlayerAction action, SimTime time) => actions.Do(action, time);

    public string WaitsFor(SimTime now) => Parts.World.Live is not null ? Parts.World.BeginsIn
        : $"{Roster.PlayerCount} of the {options.ExpectedClients} players that this host waits for are in.";

    public void Farewell(string? failure) => Roster.Farewell(failure);

    public string WhenFull => "The world has no more room for what may still change.";

    public bool TryRenew(SessionEnd by, string why) => false;

    public bool TendWorld(SimTime now) => Enforcer.Tend(now);

    /// <summary>Sends an update to every client on the next step.</summary>
    internal void Flush() => broadcast.Flush();

    public void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (!Parts.Status.HasEnded && ConnectRequestDatagram.TryReadAnyVersion(datagram, out ulong nonce))
        {
            Handshake.OnOtherVersion(nonce, from);
        }
    }

    public void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from, bool isSealed)
    {
        SessionCounters counters = Parts.Counters;
        if (Parts.Status.HasEnded)
        {
            counters.DatagramsIgnored++;
            return;
        }

        switch (type)
        {
            case DatagramType.ConnectRequest when counters.IsWellFormed(ConnectRequestDatagram.TryDecode(datagram, out ConnectRequestDatagram request, out _)):
                Handshake.Challenge(request, from);
                break;
            case DatagramType.Join when counters.IsWellFormed(JoinDatagram.TryDecode(datagram, out JoinDatagram join, out _)):
                Handshake.OnJoin(join, from);
                break;
            case DatagramType.SecureJoin when counters.IsWellFormed(
                SecureJoinDatagram.TryDecode(datagram, out SecureJoinDatagram secure, out _)):
                Handshake.OnJoin(secure, from);
                break;
            case DatagramType.SnapshotRequest when counters.IsWellFormed(SnapshotRequestDatagram.TryDecode(datagram, out SnapshotRequestDatagram request, out _)):
                Handshake.OnSnapshotRequest(request, from);
                break;
            case DatagramType.Move when counters.IsWellFormed(MoveDatagram.TryDecode(datagram, out MoveDatagram move, out _)):
                Handshake.OnMove(move, from);
                break;
            case DatagramType.DesyncQuery when counters.IsWellFormed(DesyncQueryDatagram.TryDecode(datagram, out DesyncQueryDatagram query, out _)):
                DesyncReport.OnDesyncQuery(query, from);
                break;
            case DatagramType.RosterReceived when counters.IsWellFormed(
                RosterReceivedDatagram.TryDecode(datagram, out RosterReceivedDatagram received, out _)):
                peers.OnReceived(received, from);
                break;
            case DatagramType.KeyExchange when counters.IsWellFormed(
                KeyExchangeDatagram.TryDecode(datagram, type, out KeyExchangeDatagram offer, out _)):
                Handshake.Keys.OnOffer(offer, from);
                break;
            case DatagramType.Leave when counters.IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)):
                OnLeave(leave, from);
                break;
            case DatagramType.Welcome or DatagramType.Refusal or DatagramType.Challenge or DatagramType.SnapshotChunk
                or DatagramType.DesyncReport or DatagramType.Seat or DatagramType.MoveChallenge or DatagramType.SecureWelcome
                or DatagramType.SecureRefusal or DatagramType.Reset or DatagramType.Roster or DatagramType.KeyExchangeReply:
                counters.DatagramsIgnored++; // only a host sends these
                break;
        }
    }

    public LinkSeal? SealOf(ulong sessionId) => Roster.Of(sessionId)?.Link.Seal;

    public void OnStrayDatagram(ulong sessionId, PeerAddress from)
    {
        Parts.Counters.DatagramsIgnored++;
        Handshake.OnStray(sessionId, from);
    }

    public void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        bool hasEnded = Parts.Status.HasEnded;
        Client? client = Roster.Of(update.SessionId);
        if (client is not null && client.Link.Other != from && !hasEnded)
        {
            Parts.Counters.DatagramsIgnored++; // the client sends it again, once it has proved its address
            Handshake.Challenge(client.Link, from);
            return;
        }

        if (client is null || (update.Peer != client.Peer && update.Peer != 0) || hasEnded)
        {
            Parts.Counters.DatagramsIgnored++;
            if (hasEnded || client is null)
            {
                Handshake.OnStray(update.SessionId, from);
            }

            return;
        }

        Take(update, client, Parts.Clock.Now);
    }

    public void WipeKeys() => Roster.WipeKeys();

    public void Tend(SimTime now)
    {
        timeouts.Tend(now);
        if (now > SessionParts.MaxClock)
        {
            string why = FormattableString.Invariant($"The session has lasted {SessionParts.MaxClock.ToSeconds():F0} s, the longest there is;")
                + " host a new one.";
            Farewell(why);
            Parts.Status.End(SessionEnd.Failed, why);
            return;
        }

        if (Parts.World.Live is null && Roster.PlayerCount >= options.ExpectedClients)
        {
            Parts.Start.Begin(now + options.StartLead);
            Flush();
        }

        players.Tend(now);
        foreach (Client client in Roster.All)
        {
            events.ValidateNext(client, now); // deferred earlier
        }

        Parts.Commits.Commit(Watermark.Now);
        Log.Settle();
        Handshake.Snapshots.Forget(now);
        Log.Lines.ForgetUpTo(Roster.All.Aggregate(
            Handshake.Snapshots.NeededAfter, (least, client) => Math.Min(least, client.Acknowledged)));
        broadcast.Tend(now);
        peers.Tend(now);
    }

    public SimTime NextDue(SimTime now)
    {
        SimTime due = Parts.Commits.NextDue(Watermark.Behind);
        due = SimTime.Min(due, SimTime.Min(peers.NextDue(), players.NextDue()));
        due = options.ConfirmsEarly && Parts.World.Live is not null ? SimTime.Min(due, now + Watermark.Pace) : due;
        foreach (Client client in Roster.All)
        {
            due = SimTime.Min(due, client.HasWritten ? client.Link.Due : timeouts.NextLook(client, now));
            due = client.Incoming.HasNext ? SimTime.Min(due, now + options.ResendInterval) : due;
        }

        return due;
    }

    private void OnLeave(in LeaveDatagram leave, PeerAddress from)
    {
        if (Roster.Of(leave.SessionId) is not Client client || client.Link.Other != from || (client.Peer != leave.Peer && leave.Peer != 0)
            || !Roster.Disconnect(client, leave.Reason == LeaveReason.Away ? LeaveReason.Away : LeaveReason.Left))
        {
            Parts.Counters.DatagramsIgnored++;
        }
    }

    /// <summary>Handles an update from a client: what it has, what it did, and whether it is ready for a number.</summary>
    private void Take(UpdateDatagram update, Client client, SimTime now)
    {
        if (timeouts.IsSilent(client, now))
        {
            client.NoteSilence();
        }

        bool isAcknowledgement = update.Held.Length == 0 && client.Link.IsAwaiting; // an answer to an answer helps nobody
        if (!client.Link.Note(update, now, out _))
        {
            Parts.Counters.DatagramsIgnored++;
            return;
        }

        client.Link.CountReceived(update.EncodedLength);
        client.States.NoteEcho(update.EchoNumber);
        client.HasWritten = true;
        if (update.Ready && client.Peer == 0 && (!Handshake.TrySeat(client, now) || Roster.Of(update.SessionId) != client))
        {
            return; // refused; or a handler sent it away as soon as it was in
        }

        if (client.Peer > 0)
        {
            Parts.Port.NoteSeated(client.Link.Other);
        }

        client.HasBegun |= update.Start != SimTime.MinValue;
        if (update.Peer == 0)
        {
            if (client.Peer > 0)
            {
                Handshake.Seating.Tell(client); // it does not know its number yet
            }

            client.Link.Answer(now);
            return;
        }

        if (update.EventsReceived <= LogLength)
        {
            client.Link.Acknowledge(update.EventsReceived, now);
        }

        TakeEvents(update, client, now);
        if (!isAcknowledgement)
        {
            Answer(update, client.Link, now);
        }
    }

    private void TakeEvents(UpdateDatagram update, Client client, SimTime now)
    {
        uint sequence = update.FirstIndex;
        bool isNear = true;
        foreach (UpdateEntry entry in update.Held)
        {
            isNear &= client.Incoming.Put(sequence++, entry);
        }

        if (update.Watermark != SimTime.MinValue && sequence > 0)
        {
            client.Incoming.Promise(sequence - 1, update.Watermark);
        }

        Parts.Counters.DatagramsIgnored += isNear ? 0 : 1; // further ahead than any genuine client goes
        Parts.Counters.EventsDeferred += events.ValidateNext(client, now) ? 0 : 1;
    }

    /// <summary>
    /// Answers an update: without events at once, since it asks whether this host is there, and to complete a clock exchange; with events
    /// together with what others do. Keyframes come many a second, and can wait.
    /// </summary>
    private static void Answer(UpdateDatagram update, UpdateLink link, SimTime now)
    {
        bool areKeyframes = update.Held.Length > 0;
        foreach (UpdateEntry entry in update.Held)
        {
            areKeyframes &= !entry.IsOwn && SendWindow.IsMadeUpFor(entry.Event);
        }

        if (areKeyframes)
        {
            link.Flush(now + UpdateLink.MaxAckDelay);
        }
        else if (update.Held.Length > 0)
        {
            link.AnswerSoon(now);
        }
        else
        {
            link.Answer(now);
        }
    }
}
