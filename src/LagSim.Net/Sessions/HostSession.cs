using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The peer that others join. It alone says yes or no to each event, once, and keeps the log in which all verdicts stand in order.</summary>
/// <remarks>Its clock is the session's. The watermark, before which it accepts nothing, follows that clock, so a silent joiner stalls nobody.</remarks>
public sealed class HostSession : Session
{
    private readonly List<LoggedVerdict> log = new();
    private readonly List<Joiner> joiners = new();
    private readonly bool[] hasActed = new bool[byte.MaxValue + 1]; // by number: an event that bears it was judged
    private readonly ulong sessionId;
    private ulong joins;

    /// <summary>Opens a session and waits for joiners.</summary>
    /// <param name="scene">The scene that all share.</param>
    /// <param name="port">What carries datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's own clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="sessionId">
    /// A number that no other session on these machines has; choose it at random. It is the first joiner's, and each further one gets the next:
    /// so what is still on its way from or to a former joiner is not taken for that of one who came later with the same address and number.
    /// </param>
    public HostSession(Scene scene, IDatagramPort port, IClock clock, SessionOptions options, ulong sessionId)
        : base(scene, port, clock, options)
    {
        this.sessionId = sessionId;
        SharedTime.Adjust(SimDuration.Zero);
        State = SessionState.Waiting;
    }

    /// <summary>How many joiners there are now.</summary>
    public int JoinerCount => joiners.Count;

    /// <summary>The time before which no event is accepted any more.</summary>
    public SimTime Watermark => SharedTime.Now - Options.History;

    private protected override void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
        }
        else if (type == DatagramType.Join)
        {
            if (IsWellFormed(JoinDatagram.TryDecode(datagram, out JoinDatagram join, out _)))
            {
                OnJoin(join, from);
            }
        }
        else if (type == DatagramType.Leave)
        {
            if (IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _))
                && joiners.RemoveAll(j => j.Link.Other == from && j.Peer == leave.Peer && j.Link.SessionId == leave.SessionId) == 0)
            {
                Counters.DatagramsIgnored++;
            }
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private protected override void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        Joiner? joiner = joiners.Find(j => j.Link.Other == from);
        if (joiner is null || update.SessionId != joiner.Link.SessionId || update.Peer != joiner.Peer || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            if (joiner is not null && State == SessionState.Ended)
            {
                SayGoodbye(joiner, LeaveReason.HostEnded); // it has not heard the first one
            }

            return;
        }

        SimTime now = Clock.Now;
        joiner.Link.Note(update, now);
        joiner.HasWritten = true;
        joiner.Ready |= update.Ready;
        if (update.EventsReceived > joiner.Acknowledged && update.EventsReceived <= log.Count)
        {
            joiner.Acknowledged = update.EventsReceived;
        }

        uint sequence = update.FirstIndex;
        if (update.Entries.Length > 0 && sequence > joiner.EventsReceived + 1)
        {
            Counters.DatagramsIgnored++; // a gap, which no joiner of ours leaves: each update has all that is not acknowledged
        }

        foreach (UpdateEntry entry in update.Entries)
        {
            if (sequence++ == joiner.EventsReceived + 1)
            {
                joiner.EventsReceived++;
                hasActed[joiner.Peer] = true;
                Judge(entry.Event, joiner.Peer, joiner.EventsReceived);
            }
        }

        // An answer at once: it carries the acknowledgement, and the joiner's clock has its exchange without waiting.
        joiner.Link.Hasten(now);
    }

    private protected override void Tend(SimTime now)
    {
        for (int i = joiners.Count - 1; i >= 0; i--)
        {
            if (now - joiners[i].Link.Heard > Options.Timeout)
            {
                SayGoodbye(joiners[i], LeaveReason.TimedOut);
                joiners.RemoveAt(i);
            }
        }

        if (World is null && joiners.FindAll(j => j.Ready).Count >= Options.ExpectedJoiners)
        {
            Begin(now + Options.StartLead);
            foreach (Joiner joiner in joiners)
            {
                joiner.Link.Hasten(now);
            }
        }

        Commit(Watermark);
        foreach (Joiner joiner in joiners)
        {
            if (joiner.HasWritten && joiner.Link.Due <= now)
            {
                SendUpdate(joiner, now);
            }
        }
    }

    private protected override SimTime NextDue(SimTime now)
    {
        SimTime due = SimTime.MaxValue;
        foreach (Joiner joiner in joiners)
        {
            due = SimTime.Min(due, joiner.HasWritten ? joiner.Link.Due : joiner.Link.Heard + Options.Timeout + SimDuration.OneTick);
        }

        return due;
    }

    private protected override void Publish(in ExternalEvent external) => Record(external, Verdict.Accepted);

    private protected override void Farewell()
    {
        foreach (Joiner joiner in joiners)
        {
            SayGoodbye(joiner, LeaveReason.HostEnded);
        }
    }

    private void SayGoodbye(Joiner joiner, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(joiner.Link.SessionId, 0, reason).Encode(bytes)), joiner.Link.Other);
    }

    private void OnJoin(in JoinDatagram join, PeerAddress from)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.WelcomeBytes];
        ulong nonce = join.Nonce;
        Joiner? known = joiners.Find(j => j.Link.Other == from && j.Nonce == nonce);
        if (known is null)
        {
            // Somebody may only pretend to be at this address: who is there and was heard of is not put out for it.
            if (joiners.Exists(j => j.Link.Other == from && j.HasWritten && !IsOverdue(j.Link.Silence(Clock.Now))))
            {
                Counters.DatagramsIgnored++;
                return;
            }

            int others = joiners.FindAll(j => j.Link.Other != from).Count;
            byte number = FreeNumber(from);
            RefusalReason? refusal = join.ConnectKey != Options.ConnectKey ? RefusalReason.WrongKey
                : join.SceneHash != Scene.Hash ? RefusalReason.SceneDiffers
                : others >= SessionOptions.MaxJoiners || number == 0 ? RefusalReason.Full
                : null;
            if (refusal is RefusalReason reason)
            {
                Counters.DatagramsIgnored++;
                Send(bytes.Slice(0, new RefusalDatagram(nonce, reason).Encode(bytes)), from);
                return;
            }

            joiners.RemoveAll(j => j.Link.Other == from); // the same address under a new nonce: it started again
            known = new Joiner(number, nonce, new UpdateLink(sessionId + joins++, 0, from, Clock.Now));
            joiners.Add(known);
        }

        Send(bytes.Slice(0, new WelcomeDatagram(nonce, known.Link.SessionId, known.Peer, Options.History).Encode(bytes)), from);
    }

    /// <summary>The least number that no other address has and that stands in no event; 0 if there is none.</summary>
    private byte FreeNumber(PeerAddress from)
    {
        for (int number = 1; number <= byte.MaxValue; number++)
        {
            if (!hasActed[number] && !joiners.Exists(j => j.Peer == number && j.Link.Other != from))
            {
                return (byte)number;
            }
        }

        return 0;
    }

    private void Judge(in ExternalEvent external, byte sender, uint sequence)
    {
        if (external.Peer != sender || external.Sequence != sequence)
        {
            Counters.EventsRefused++; // in another's name; in the log it would have that other take back what it did itself
            return;
        }

        SimTime now = SharedTime.Now;
        Verdict verdict = World is null || !MayEnter(external) ? Verdict.Invalid
            : external.Time < now - Options.History || external.Time < World.Simulation.Start ? Verdict.TooLate
            : external.Time > now + Options.History ? Verdict.TooEarly
            : Verdict.Accepted;
        if (verdict == Verdict.Accepted)
        {
            Apply(external);
        }

        Record(external, verdict);
    }

    private void Record(in ExternalEvent external, Verdict verdict)
    {
        Counters.EventsAccepted += verdict == Verdict.Accepted ? 1 : 0;
        Counters.EventsRefused += verdict == Verdict.Accepted ? 0 : 1;
        log.Add(new LoggedVerdict(external, verdict));
        SimTime now = Clock.Now;
        foreach (Joiner joiner in joiners)
        {
            joiner.Link.Hasten(now);
        }
    }

    private void SendUpdate(Joiner joiner, SimTime now)
    {
        UpdateDatagram update = joiner.Link.Compose(now);
        update.EventsReceived = joiner.EventsReceived;
        update.Start = World?.Simulation.Start ?? SimTime.MinValue;
        update.FirstIndex = joiner.Acknowledged + 1;
        int next = (int)joiner.Acknowledged;
        while (next < log.Count && update.TryAdd(log[next].Verdict, log[next].Event))
        {
            next++;
        }

        // The watermark is a promise about the whole log: with an entry left out it could not yet be relied on.
        update.Watermark = World is null || next < log.Count ? SimTime.MinValue : Watermark;
        SimDuration wait = WaitAfterUpdate(next > joiner.Acknowledged, joiner.Link.Silence(now));
        Send(joiner.Link.Seal(now + wait), joiner.Link.Other);
    }

    private sealed class Joiner
    {
        internal Joiner(byte peer, ulong nonce, UpdateLink link)
        {
            Peer = peer;
            Nonce = nonce;
            Link = link;
        }

        internal byte Peer { get; }

        internal ulong Nonce { get; }

        internal UpdateLink Link { get; }

        internal bool Ready { get; set; }

        /// <summary>Whether an update of it came. Until then it gets none: an address that only a stranger gave must not be flooded.</summary>
        internal bool HasWritten { get; set; }

        /// <summary>How many entries of the log it has.</summary>
        internal uint Acknowledged { get; set; }

        /// <summary>How many of its events are judged.</summary>
        internal uint EventsReceived { get; set; }
    }
}
