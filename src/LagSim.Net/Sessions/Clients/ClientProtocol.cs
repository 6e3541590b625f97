using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// The client side of the session protocol: routes each datagram to the part that handles it, and lets each part do what is due.
/// </summary>
internal sealed class ClientProtocol : ISessionProtocol
{
    /// <summary>A clock estimate may be corrected by up to this much even on a bad link.</summary>
    private static readonly SimDuration MinJump = SimDuration.FromSeconds(1);

    private readonly JoinAttempts attempts;
    private readonly SnapshotClient snapshot;
    private readonly WorldEntry entry;
    private readonly LogFollower log;
    private readonly ClientUpdates updates;
    private readonly SuspendDetector suspend;
    private readonly RosterFollower peers;
    private readonly JoinProgress progress;
    private readonly KeyRenewal keys;

    internal ClientProtocol(SessionParts parts, ClientOptions options, PeerAddress host, ulong nonce)
    {
        Parts = parts;
        attempts = new JoinAttempts(nonce, parts.Clock.Now);
        suspend = new SuspendDetector(options.Timeout / 2);
        Connection = new HostConnection(host, options.OtherAddresses, parts.Links, parts.Self, parts.Sender, parts.Counters, options.HostName);
        Seat = new PlayerSeat(attempts, Connection, parts.SharedTime, parts.Status, parts.Counters, parts.Clock, options.Pass);
        LastAnswer answer = new();
        progress = new JoinProgress(attempts, Connection, answer, parts.World, parts.Status, options.IsProtected);
        Requests = new JoinRequests(
            attempts, Connection, Seat, answer, parts.World, parts.Status, parts.Sender, parts.Counters, parts.Clock, options);
        snapshot = new SnapshotClient(
            attempts, Connection, parts.World, parts.Status, parts.Sender, parts.Counters, parts.Clock, new SceneCode(options.Accelerations, options.Rules));
        entry = new WorldEntry(attempts, Connection, parts.Start, parts.SharedTime, parts.Status, parts.Clock, options.Timeout);
        log = new LogFollower(
            Connection, parts.World, parts.Commits, parts.Journal, parts.Self, parts.SharedTime, parts.Counters, parts.Clock);
        updates = new ClientUpdates(Connection, attempts, parts.World, parts.SharedTime, parts.KeepAlive, parts.Sender);
        peers = new RosterFollower(Connection, parts.Peers, parts.SharedTime, parts.Sender, parts.Counters, options.Timeout / 2);
        keys = new KeyRenewal(Connection, parts.Sender, parts.Counters);
        Loss = new HostLoss(attempts, Connection, progress, answer, parts.World, parts.Status, parts.Counters, parts.Clock, options);
        Finder = new DivergenceFinder(
            Connection, parts.World, parts.Journal, parts.Self, parts.Sender, parts.Counters, parts.Clock, options.Timeout);
        parts.Commits.Compared += Finder.OnCompared;
        Finder.Confirmed += GiveUpWorld;
        Loss.Interrupted += _ => Finder.Cancel();
    }

    public IReadOnlyList<LinkTraffic> Traffic => Connection.Link is UpdateLink link ? [link.Traffic] : [];

    public uint LogLength => Connection.Log.Received;

    public uint LogStart => Seat.LogStart;

    internal SessionParts Parts { get; }

    internal HostConnection Connection { get; }

    internal JoinRequests Requests { get; }

    internal PlayerSeat Seat { get; }

    internal HostLoss Loss { get; }

    internal DivergenceFinder Finder { get; }

    public void Farewell(string? failure) => Connection.Farewell(isChosen: failure is null);

    public string WaitsFor(SimTime now) => progress.WaitsFor(now);

    public void WipeKeys()
    {
        attempts.Finish();
        Connection.Close();
    }

    public string WhenFull => "This peer has no more room for what may still change, and left; it can join again.";

    public bool TryRenew(SessionEnd by, string why) => Loss.TryRenew(by, why);

    public bool TendWorld(SimTime now) => false;

    public ExternalEvent Do(in PlayerAction action, SimTime time)
    {
        Parts.Actions.ThrowIfNotRunning();
        if (Connection.Unconfirmed.Count >= ClientSession.MaxUnconfirmedEvents)
        {
            throw new InvalidOperationException(
                $"Nothing more can be done yet: {Connection.Unconfirmed.Count} events of this peer wait for the host's verdict,"
                + " and that is the most that may.");
        }

        ExternalEvent external = Parts.Actions.Submit(action, SimTime.Max(time, Connection.Promises.Earliest));
        Connection.Publish(external, Parts.Clock.Now);
        return external;
    }

    public void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (Connection.IsHost(from) && RefusalDatagram.TryReadAnyVersion(datagram, out ulong nonce, out byte version))
        {
            Requests.OnOtherVersion(nonce, version, from);
        }
    }

    public void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from, bool isSealed)
    {
        SessionCounters counters = Parts.Counters;
        if (!Connection.IsHost(from) || Parts.Status.HasEnded)
        {
            counters.DatagramsIgnored++;
            return;
        }

        switch (type)
        {
            case DatagramType.Challenge when counters.IsWellFormed(
                ChallengeDatagram.TryDecode(datagram, out ChallengeDatagram challenge, out _)):
                Requests.OnChallenge(challenge, from);
                break;
            case DatagramType.Welcome when counters.IsWellFormed(WelcomeDatagram.TryDecode(datagram, out WelcomeDatagram welcome, out _)):
                Requests.OnWelcome(welcome);
                break;
            case DatagramType.SecureWelcome when counters.IsWellFormed(
                SecureAnswerDatagram.TryDecode(datagram, type, out SecureAnswerDatagram answer, out _)):
                Requests.OnSecureWelcome(answer);
                break;
            case DatagramType.SecureRefusal when counters.IsWellFormed(
                SecureAnswerDatagram.TryDecode(datagram, type, out SecureAnswerDatagram answer, out _)):
                Requests.OnSecureRefusal(answer);
                break;
            case DatagramType.MoveChallenge when counters.IsWellFormed(
                MoveChallengeDatagram.TryDecode(datagram, out MoveChallengeDatagram challenge, out _)):
                Requests.OnMoveChallenge(challenge);
                break;
            case DatagramType.Reset when counters.IsWellFormed(ResetDatagram.TryDecode(datagram, out ResetDatagram reset, out _)):
                Loss.OnReset(reset);
                break;
            case DatagramType.Refusal when counters.IsWellFormed(RefusalDatagram.TryDecode(datagram, out RefusalDatagram refusal, out _)):
                Requests.OnRefusal(refusal, isSealed, from);
                break;
            case DatagramType.SnapshotChunk when counters.IsWellFormed(SnapshotChunkDatagram.TryDecode(datagram, out SnapshotChunkDatagram chunk, out _)):
                snapshot.OnSnapshotChunk(chunk, datagram.Length);
                break;
            case DatagramType.DesyncReport when counters.IsWellFormed(
                DesyncReportDatagram.TryDecode(datagram, out DesyncReportDatagram report, out _)):
                Finder.OnDesyncReport(report, datagram.Length);
                break;
            case DatagramType.Leave when counters.IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)):
                Loss.OnLeave(leave);
                break;
            case DatagramType.Seat when counters.IsWellFormed(SeatDatagram.TryDecode(datagram, out SeatDatagram seat, out _)):
                Seat.OnSeat(seat);
                break;
            case DatagramType.KeyExchangeReply when counters.IsWellFormed(
                KeyExchangeDatagram.TryDecode(datagram, type, out KeyExchangeDatagram reply, out _)):
                keys.OnReply(reply);
                break;
            case DatagramType.Roster:
                peers.OnRoster(datagram);
                break;
            case DatagramType.ConnectRequest or DatagramType.Join or DatagramType.SnapshotRequest or DatagramType.DesyncQuery
                or DatagramType.Move or DatagramType.SecureJoin or DatagramType.RosterReceived or DatagramType.KeyExchange:
                counters.DatagramsIgnored++; // only a client sends these
                break;
        }
    }

    public LinkSeal? SealOf(ulong sessionId) => Connection.Link is UpdateLink link && link.SessionId == sessionId ? link.Seal : null;

    public void OnStrayDatagram(ulong sessionId, PeerAddress from) => Parts.Counters.DatagramsIgnored++;

    public void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        bool isOurs = Connection.Link is not null && from == Connection.Host && update.SessionId == Connection.Link.SessionId;
        if (isOurs && Parts.Status.HasEnded)
        {
            Parts.Counters.DatagramsIgnored++;
            Connection.SayGoodbye(); // it missed the first goodbye
        }
        else if (!isOurs || update.Peer != 0)
        {
            Parts.Counters.DatagramsIgnored++;
        }
        else
        {
            Take(update, Connection.Link!, Parts.Clock.Now);
        }
    }

    public void Tend(SimTime now)
    {
        attempts.Begin(now);
        SimDuration slept = suspend.Look(now);
        if (slept > SimDuration.Zero)
        {
            // This machine slept, or its clock jumped: the host was not silent, we were not listening.
            Connection.Link?.NoteHeard(now);
            keys.NoteSuspend(now);
            Loss.NoteSuspend(slept);
            attempts.NoteSuspend(slept, now);
        }

        Loss.Tend(now);
        if (Parts.Status.HasEnded)
        {
            return;
        }

        peers.Tend(now);
        if (attempts.IsAsking)
        {
            Requests.Tend(now);
        }
        else
        {
            snapshot.Tend(now);
            Finder.Tend(now);
            updates.Tend(now);
            TendKeys(now);
        }
    }

    public SimTime NextDue(SimTime now) => attempts.IsAsking
        ? attempts.Current!.Due
        : SimTime.Min(SimTime.Min(Connection.Link?.Due ?? now, snapshot.Due), Finder.Due);

    /// <summary>Has the link get fresh keys; one whose keys are too old is given up, as if the host were gone.</summary>
    private void TendKeys(SimTime now)
    {
        keys.Tend(now);
        if (keys.IsOverdue(now) && Parts.World.Live is not null)
        {
            Loss.Rejoin(SessionEnd.Disconnected, Loss.NoFreshKeys, isLinkGood: false);
        }
    }

    /// <summary>Handles an update from the host.</summary>
    private void Take(UpdateDatagram update, UpdateLink link, SimTime now)
    {
        if (!link.Note(update, now, out bool isNewest))
        {
            Parts.Counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(update.EncodedLength);
        Loss.NoteHeard();
        if (!FollowClock(update, link, now, isNewest))
        {
            return;
        }

        if (Parts.KeepAlive.IsOverdue(link.Silence(now)))
        {
            // The host has not heard from this peer; it answers every update at once, so the other direction takes care of itself.
            link.Flush(now);
        }

        // The clock is set first: it decides whether events are late.
        Connection.IsStartTold = update.Start != SimTime.MinValue;
        log.Keep(update); // flush in any case, so that the host does not send the same entries again
        if (attempts.Current is not null)
        {
            TryBegin(update.Start);
            if (attempts.Current is not null || Parts.Status.HasEnded)
            {
                return;
            }

            link.Flush(now); // repeated until the host knows that the world has begun
        }

        link.Acknowledge(Math.Min(update.EventsReceived, Parts.Self.LastSequence), now);
        TakeEntries(update, now);
    }

    /// <summary>Sets this peer's clock by the host's.</summary>
    /// <returns>False if the two are so far apart that this peer abandoned its world.</returns>
    private bool FollowClock(UpdateDatagram update, UpdateLink link, SimTime now, bool isNewest)
    {
        bool isIn = attempts.Current is null;
        ClockSync clock = attempts.Current?.Clock ?? Seat.Clock;
        bool isExchange = isNewest && link.TryGetSent(update.EchoNumber, out SimTime echoSent)
            && clock.Add(echoSent, update.EchoReceived, update.Sent, now) && clock.IsReady;
        if (!isExchange || !isIn)
        {
            return true;
        }

        SharedClock sharedTime = Parts.SharedTime;
        sharedTime.Adjust(clock.Estimate);
        SimDuration off = sharedTime.Remaining < SimDuration.Zero ? -sharedTime.Remaining : sharedTime.Remaining;
        // An exchange that waited long, in a stall, is imprecise.
        if (off <= Connection.History || off <= MinJump || off <= clock.Estimate.ErrorBound)
        {
            return true;
        }

        // Bending the clock back at 5 % takes twenty times as long, and until then every action here would be refused.
        string why = FormattableString.Invariant($"This machine's clock and the host's are {off.ToSeconds():0.###} s further apart than")
            + " before: one of them jumped, or the machine slept.";
        Loss.Rejoin(SessionEnd.Failed, why, isLinkGood: false);
        return false;
    }

    /// <summary>Begins the world, or replaces it with a fresh snapshot, if everything needed is there.</summary>
    private void TryBegin(SimTime start)
    {
        if (!entry.TryBegin(start))
        {
            return;
        }

        Finder.Reset();
        if (Parts.Status.IsRejoining)
        {
            Loss.NoteRenewed();
            Parts.Status.State = SessionState.Waiting;
        }
    }

    private void TakeEntries(UpdateDatagram update, SimTime now)
    {
        long lost = Parts.Counters.EventsLost;
        if (!log.TakeEntries(now) && update.Held.Length > 0)
        {
            // Entries that arrived early, or again, are acknowledged too, otherwise they are sent again (RFC 9000, 13.2.1).
            Connection.Link?.AnswerSoon(now);
        }

        if (Parts.Counters.EventsLost > lost && Parts.World.PromisesAgreement)
        {
            Loss.Rejoin(SessionEnd.Failed, "An accepted event came too late for the history that this peer still had.", isLinkGood: false);
        }
        else
        {
            Parts.Commits.Compare(update);
        }
    }

    /// <summary>Abandons a world that is known to be wrong. The counters and the first differing state are kept.</summary>
    private void GiveUpWorld()
    {
        if (Parts.World.PromisesAgreement)
        {
            Loss.Rejoin(SessionEnd.Failed, "A committed state of this peer was not the host's.", isLinkGood: false);
        }
    }
}
