using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A peer that joins a host's session.</summary>
/// <remarks>It sets its clock by the host's before its first tick. Its own events show at once; one that the host refuses is taken back.</remarks>
public sealed class JoinerSession : Session
{
    /// <summary>How long between two tries to be let in, and between two exchanges while the clock is set.</summary>
    private static readonly SimDuration Pace = SimDuration.FromMilliseconds(20);

    private readonly List<ExternalEvent> unjudged = new(); // own events whose verdict has not come, oldest first
    private readonly PeerAddress host;
    private readonly ulong nonce;
    private readonly SimTime began;
    private UpdateLink? link;
    private SimTime joinDue;
    private uint entriesReceived;
    private uint acknowledged; // how many own events the host has; their verdicts may come later

    /// <summary>Asks to be let in, from the first step on.</summary>
    /// <param name="scene">The scene that the host is expected to have.</param>
    /// <param name="port">What carries datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's own clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="host">Where the host is.</param>
    /// <param name="nonce">A number chosen at random; an answer must bear it.</param>
    public JoinerSession(Scene scene, IDatagramPort port, IClock clock, SessionOptions options, PeerAddress host, ulong nonce)
        : base(scene, port, clock, options)
    {
        this.host = host;
        this.nonce = nonce;
        began = Clock.Now;
        joinDue = began;
        State = SessionState.Joining;
    }

    /// <summary>How late the host accepts an event, as it said; zero before it has.</summary>
    public SimDuration History { get; private set; }

    /// <summary>What is known of the distance between the two clocks.</summary>
    public ClockSync ClockSync { get; } = new();

    private protected override void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (from != host || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
        }
        else if (type == DatagramType.Welcome)
        {
            if (IsWellFormed(WelcomeDatagram.TryDecode(datagram, out WelcomeDatagram welcome, out _)))
            {
                OnWelcome(welcome);
            }
        }
        else if (type == DatagramType.Refusal)
        {
            if (IsWellFormed(RefusalDatagram.TryDecode(datagram, out RefusalDatagram refusal, out _)))
            {
                OnRefusal(refusal);
            }
        }
        else if (type == DatagramType.Leave)
        {
            if (IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)))
            {
                OnLeave(leave);
            }
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private protected override void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        if (link is null || from != host || update.SessionId != link.SessionId || update.Peer != 0 || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            return;
        }

        SimTime now = Clock.Now;
        if (link.Note(update, now) && update.EchoSent != SimTime.MinValue
            && ClockSync.Add(update.EchoSent, update.EchoReceived, update.Sent, now) && ClockSync.IsReady)
        {
            SharedTime.Adjust(ClockSync.Offset);
            State = State == SessionState.Synchronising ? SessionState.Waiting : State;
        }

        if (IsOverdue(link.Silence(now)))
        {
            link.Hasten(now); // the host has not heard of this peer; it answers every update at once, so the other way is looked after
        }

        // Its clock is set first: events are late or not by it.
        if (SharedTime.IsSet && update.Start != SimTime.MinValue)
        {
            Begin(update.Start);
            TakeEntries(update, now);
        }

        acknowledged = Math.Max(acknowledged, Math.Min(update.EventsReceived, LastSequence));
    }

    private protected override void Tend(SimTime now)
    {
        SimTime heard = link?.Heard ?? began;
        if (now - heard > Options.Timeout)
        {
            End(link is null
                ? FormattableString.Invariant($"No answer from {host} within {Options.Timeout.ToSeconds():0.###} s.")
                : FormattableString.Invariant($"The host at {host} fell silent for {Options.Timeout.ToSeconds():0.###} s."));
            return;
        }

        if (link is null)
        {
            if (joinDue <= now)
            {
                Span<byte> bytes = stackalloc byte[WireFormat.JoinBytes];
                Send(bytes.Slice(0, new JoinDatagram(Options.ConnectKey, nonce, Scene.Hash).Encode(bytes)), host);
                joinDue = now + Pace;
            }
        }
        else if (link.Due <= now)
        {
            SendUpdate(link, now);
        }
    }

    private protected override SimTime NextDue(SimTime now) => link?.Due ?? joinDue;

    private protected override void Publish(in ExternalEvent external)
    {
        unjudged.Add(external);
        link!.Hasten(Clock.Now);
    }

    private protected override void Farewell()
    {
        if (link is not null)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
            Send(bytes.Slice(0, new LeaveDatagram(link.SessionId, Peer, LeaveReason.Left).Encode(bytes)), host);
        }
    }

    private static string Sentence(RefusalReason reason) => reason switch
    {
        RefusalReason.VersionDiffers => "it speaks another version of the protocol.",
        RefusalReason.SceneDiffers => "its scene is another one.",
        RefusalReason.WrongKey => "the key is wrong.",
        RefusalReason.Full => "the session is full.",
        _ => $"reason {(int)reason}.",
    };

    private void OnWelcome(in WelcomeDatagram welcome)
    {
        if (State == SessionState.Joining && welcome.Nonce == nonce)
        {
            Peer = welcome.Peer;
            History = welcome.History;
            link = new UpdateLink(welcome.SessionId, welcome.Peer, host, Clock.Now);
            State = SessionState.Synchronising;
        }
        else if (welcome.Nonce != nonce)
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void OnRefusal(in RefusalDatagram refusal)
    {
        if (refusal.Nonce == nonce && State == SessionState.Joining)
        {
            End($"The host at {host} refused: {Sentence(refusal.Reason)}");
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void OnLeave(in LeaveDatagram leave)
    {
        if (link is not null && leave.SessionId == link.SessionId && leave.Peer == 0)
        {
            End(leave.Reason == LeaveReason.TimedOut ? $"The host at {host} heard nothing from this peer for too long." : $"The host at {host} ended the session.");
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void TakeEntries(UpdateDatagram update, SimTime now)
    {
        uint index = update.FirstIndex;
        bool any = false;
        foreach (UpdateEntry entry in update.Entries)
        {
            if (index++ == entriesReceived + 1)
            {
                entriesReceived++;
                any = true;
                Take(entry);
            }
        }

        // The watermark speaks of the log up to this update's last entry; with a gap before it, it does not hold here yet.
        if (update.Watermark != SimTime.MinValue && index <= entriesReceived + 1)
        {
            // What is not judged yet, or still to be done, may have to be taken back, and for that its history must be there. Own stamps
            // never go back. That the host has an event is not enough: an older update may come between that and its verdict.
            SimTime needed = unjudged.Count > 0 ? unjudged[0].Time : SharedTime.Now;
            Commit(SimTime.Min(update.Watermark, needed));
        }

        if (any)
        {
            link!.Hasten(now);
        }
    }

    private void Take(in UpdateEntry entry)
    {
        ExternalEvent external = entry.Event;
        bool own = external.Peer == Peer;
        bool accepted = entry.Verdict == Verdict.Accepted && MayEnter(external);
        Counters.EventsAccepted += accepted ? 1 : 0;
        Counters.EventsRefused += accepted ? 0 : 1;
        while (own && unjudged.Count > 0 && unjudged[0].Sequence <= external.Sequence)
        {
            unjudged.RemoveAt(0); // a peer's own events stand in the log in their order
        }

        if (own && !accepted)
        {
            Counters.EventsLost += World!.Retract(external) ? 0 : 1;
        }
        else if (!own && accepted)
        {
            Apply(external);
        }
    }

    private void SendUpdate(UpdateLink to, SimTime now)
    {
        UpdateDatagram update = to.Compose(now);
        update.EventsReceived = entriesReceived;
        update.Ready = SharedTime.IsSet;
        update.FirstIndex = acknowledged + 1;
        foreach (ExternalEvent external in unjudged)
        {
            if (external.Sequence > acknowledged && !update.TryAdd(Verdict.Pending, external))
            {
                break;
            }
        }

        SimDuration wait = !SharedTime.IsSet || World is null ? Pace : WaitAfterUpdate(acknowledged < LastSequence, to.Silence(now));
        Send(to.Seal(now + wait), host);
    }
}
