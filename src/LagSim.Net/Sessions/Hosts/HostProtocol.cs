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
/// The host's side of the session protocol: hands each datagram to the part that it is for, and has each part do in turn what is due.
/// </summary>
internal sealed class HostProtocol : ISessionProtocol
{
    private readonly PlayerPlaces places;
    private readonly JoinerTimeouts timeouts;
    private readonly JoinerEvents events;
    private readonly HostActions actions;
    private readonly LogBroadcast broadcast;

    /// <exception cref="SceneException">The scene is too large to be shared.</exception>
    internal HostProtocol(SessionParts parts, ulong sessionId)
    {
        Parts = parts;
        SessionOptions options = parts.Options;
        SimTime now = parts.Clock.Now;
        places = new PlayerPlaces(options, now);
        Roster = new JoinerRoster(places, parts.Sender, parts.Clock);
        Watermark = new Watermark(parts.SharedTime, parts.World, options.Window.History);
        Log = new AuthoritativeLog(parts.World, Watermark, parts.Journal, parts.Counters, parts.Clock);
        broadcast = new LogBroadcast(Roster, Log, Watermark, parts.World, parts.Commits, parts.KeepAlive, parts.Sender, parts.Clock);
        Log.Recorded += broadcast.NoteRecorded;
        Budget = new WorkBudget(parts.World, parts.SharedTime, options.PlayerBudget);
        timeouts = new JoinerTimeouts(Roster, Log.Lines, options.Timeout, options.Door.SlowestCopy, now);
        Door = new FrontDoor(parts, sessionId, Roster, places, Log, Budget, timeouts);
        ForeignActs acts = new(options.PlayerBudget is not null, 10 * options.MaxEventsPerSecond);
        EventValidator validator = new(parts.World, parts.SharedTime, Watermark, Budget, options.Window.History);
        events = new JoinerEvents(places, validator, parts.World, acts, Log, parts.Counters);
        actions = new HostActions(parts.Actions, Log);
        Removal = new BodyRemoval(parts.World, actions);
        Enforcer = new BudgetEnforcer(Budget, acts, Roster, Door.ShutOuts, Removal, actions, parts.World, Watermark, parts.Status);
        Evidence = new EvidenceServer(Roster, parts.Journal, parts.World, Watermark, parts.Sender, parts.Counters, parts.Clock);
        parts.SharedTime.Adjust(SimDuration.Zero);
    }

    public IReadOnlyList<LinkTraffic> Traffic => Roster.All.FindAll(j => j.Peer > 0).ConvertAll(j => j.Link.Traffic);

    public uint LogLength => Log.Lines.Count;

    public uint LogStart => 0;

    internal SessionParts Parts { get; }

    internal JoinerRoster Roster { get; }

    internal Watermark Watermark { get; }

    internal AuthoritativeLog Log { get; }

    internal FrontDoor Door { get; }

    internal WorkBudget Budget { get; }

    internal BudgetEnforcer Enforcer { get; }

    internal BodyRemoval Removal { get; }

    internal EvidenceServer Evidence { get; }

    public ExternalEvent Do(in PlayerAction action, SimTime time) => actions.Do(action, time);

    public void Farewell() => Roster.Farewell();

    public bool TryRenew(SessionEnd by, string why) => false;

    public bool TendWorld(SimTime now) => Enforcer.Tend(now);

    /// <summary>Has the next step write to every joiner.</summary>
    internal void Hasten() => broadcast.Hasten();

    public void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (!Parts.Status.HasEnded && KnockDatagram.TryReadAnyVersion(datagram, out ulong nonce))
        {
            Door.OnOtherVersion(nonce, from);
        }
    }

    public void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        SessionCounters counters = Parts.Counters;
        if (Parts.Status.HasEnded)
        {
            counters.DatagramsIgnored++;
            return;
        }

        switch (type)
        {
            case DatagramType.Knock when counters.IsWellFormed(KnockDatagram.TryDecode(datagram, out KnockDatagram knock, out _)):
                Door.Challenge(knock.Nonce, from);
                break;
            case DatagramType.Join when counters.IsWellFormed(JoinDatagram.TryDecode(datagram, out JoinDatagram join, out _)):
                Door.OnJoin(join, from);
                break;
            case DatagramType.Fetch when counters.IsWellFormed(FetchDatagram.TryDecode(datagram, out FetchDatagram fetch, out _)):
                Door.OnFetch(fetch, from);
                break;
            case DatagramType.Move when counters.IsWellFormed(MoveDatagram.TryDecode(datagram, out MoveDatagram move, out _)):
                Door.OnMove(move, from);
                break;
            case DatagramType.Doubt when counters.IsWellFormed(DoubtDatagram.TryDecode(datagram, out DoubtDatagram doubt, out _)):
                Evidence.OnDoubt(doubt, from);
                break;
            case DatagramType.Leave when counters.IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)):
                OnLeave(leave, from);
                break;
            case DatagramType.Welcome or DatagramType.Refusal or DatagramType.Challenge or DatagramType.Chunk
                or DatagramType.Evidence or DatagramType.Seat:
                counters.DatagramsIgnored++; // a host's own words
                break;
        }
    }

    public void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        bool hasEnded = Parts.Status.HasEnded;
        Joiner? joiner = Roster.Of(update.SessionId);
        if (joiner is not null && joiner.Link.Other != from && !hasEnded)
        {
            Parts.Counters.DatagramsIgnored++; // what it says comes again, once it has shown that it is there
            Door.Challenge(update.SessionId, from);
            return;
        }

        if (joiner is null || (update.Peer != joiner.Peer && update.Peer != 0) || hasEnded)
        {
            Parts.Counters.DatagramsIgnored++;
            if (hasEnded || joiner is null)
            {
                // It has not heard the goodbye, or never was one of ours. Told with its own session's number, and in fewer bytes than it
                // sent.
                Parts.Sender.SayGoodbye(from, update.SessionId, hasEnded ? LeaveReason.HostEnded : places.WhyGone(update.SessionId));
            }

            return;
        }

        Take(update, joiner, Parts.Clock.Now);
    }

    public void Tend(SimTime now)
    {
        timeouts.Tend(now);
        if (now > SessionParts.MaxClock)
        {
            Farewell();
            Parts.Status.End(
                SessionEnd.Failed,
                FormattableString.Invariant($"The session has lasted {SessionParts.MaxClock.ToSeconds():F0} s, the longest there is;")
                    + " host a new one.");
            return;
        }

        if (Parts.World.Live is null && Roster.SeatedCount >= Parts.Options.ExpectedJoiners)
        {
            Parts.Start.Begin(now + Parts.Options.StartLead);
            Hasten();
        }

        foreach (Joiner joiner in Roster.All)
        {
            events.JudgeNext(joiner, now); // what was left for later
        }

        Parts.Commits.Commit(Watermark.Now);
        Log.Settle();
        Door.Copies.Forget(now);
        Log.Lines.ForgetUpTo(Roster.All.Aggregate(Door.Copies.NeededAfter, (least, joiner) => Math.Min(least, joiner.Acknowledged)));
        broadcast.Tend(now);
    }

    public SimTime NextDue(SimTime now)
    {
        SimTime due = Parts.Commits.NextDue(Parts.Options.Window.History);
        foreach (Joiner joiner in Roster.All)
        {
            due = SimTime.Min(due, joiner.HasWritten ? joiner.Link.Due : timeouts.GivenUpAt(joiner));
            due = joiner.Incoming.HasNext ? SimTime.Min(due, now + Parts.Options.ResendInterval) : due;
        }

        return due;
    }

    private void OnLeave(in LeaveDatagram leave, PeerAddress from)
    {
        if (Roster.Of(leave.SessionId) is not Joiner joiner || joiner.Link.Other != from || (joiner.Peer != leave.Peer && leave.Peer != 0)
            || !Roster.LetGo(joiner, LeaveReason.Left))
        {
            Parts.Counters.DatagramsIgnored++;
        }
    }

    /// <summary>Takes in an update of a joiner: what it has, what it did, and whether it is ready for a number.</summary>
    private void Take(UpdateDatagram update, Joiner joiner, SimTime now)
    {
        if (timeouts.IsSilent(joiner, now))
        {
            joiner.NoteSilence();
        }

        if (!joiner.Link.Note(update, now, out _))
        {
            Parts.Counters.DatagramsIgnored++;
            return;
        }

        joiner.Link.CountReceived(update.EncodedLength);
        joiner.NoteEcho(update.EchoNumber);
        joiner.HasWritten = true;
        if (update.Ready && joiner.Peer == 0 && !Door.TrySeat(joiner, now))
        {
            return;
        }

        joiner.HasBegun |= update.Start != SimTime.MinValue;
        if (update.Peer == 0)
        {
            if (joiner.Peer > 0)
            {
                Door.Seating.Tell(joiner); // it has not heard which it has
            }

            joiner.Link.Answer(now);
            return;
        }

        if (update.EventsReceived <= LogLength)
        {
            joiner.Link.Acknowledge(update.EventsReceived, now);
        }

        TakeEvents(update, joiner, now);
    }

    private void TakeEvents(UpdateDatagram update, Joiner joiner, SimTime now)
    {
        uint sequence = update.FirstIndex;
        bool isNear = true;
        bool canWait = update.Held.Length > 0;
        foreach (UpdateEntry entry in update.Held)
        {
            isNear &= joiner.Incoming.Put(sequence++, entry);
            canWait &= !entry.IsOwn && SendWindow.IsMadeUpFor(entry.Event);
        }

        Parts.Counters.DatagramsIgnored += isNear ? 0 : 1; // further ahead than any joiner of ours goes
        Parts.Counters.EventsDeferred += events.JudgeNext(joiner, now) ? 0 : 1;

        // An answer at once: it carries the acknowledgement, and the joiner's clock has its exchange without waiting. Knots come many a
        // second, and have time.
        if (canWait)
        {
            joiner.Link.Hasten(now + UpdateLink.MostAckDelay);
        }
        else
        {
            joiner.Link.Answer(now);
        }
    }
}
