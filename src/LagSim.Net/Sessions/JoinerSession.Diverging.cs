using System;
using System.Collections.Generic;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>A committed state that is not the host's: since when, and which event makes the difference.</content>
public sealed partial class JoinerSession
{
    private Inquiry? inquiry;
    private SimTime agreed = SimTime.MinValue; // the newest committed time at which the states were the same, before the first at which they were not
    private CommittedState differing;
    private ulong hostHash;
    private volatile Divergence? divergence;

    /// <summary>
    /// Raised on the session's thread, once, when it is found out what the first differing committed state comes from, or that this cannot be. Handlers must
    /// not throw.
    /// </summary>
    public event Action<Divergence>? Diverged;

    /// <summary>The first committed state that was not the host's, and what is known of it by now; null while there is none. From any thread.</summary>
    public Divergence? Divergence => divergence;

    private protected override void OnCompared(in CommittedState own, ulong theirs)
    {
        if (own.StateHash == theirs)
        {
            agreed = inquiry is null ? SimTime.Max(agreed, own.Time) : agreed;
            return;
        }

        if (divergence is not null)
        {
            if (inquiry is null)
            {
                Renew();
            }

            return;
        }

        (differing, hostHash) = (own, theirs);
        SimTime begun = (from == SimTime.MinValue ? World!.Simulation.Start : from) - SimDuration.OneTick;
        SimTime after = agreed == SimTime.MinValue || agreed >= own.Time ? begun : agreed;
        if (!PromisesAgreement || !Recent.IsWholeAfter(after))
        {
            Conclude(after, PromisesAgreement ? DivergenceFinding.Forgotten : DivergenceFinding.NotPromised);
            return;
        }

        inquiry = new Inquiry(after, own.Time, Clock.Now);
        divergence = Describe(after, DivergenceFinding.Asking);
    }

    /// <summary>What is known to be wrong is not gone on with; that it was stays counted, and the first such state told.</summary>
    private void Renew()
    {
        if (PromisesAgreement)
        {
            Rejoin(SessionEnd.Failed, "A committed state of this peer was not the host's.", isLinkGood: false);
        }
    }

    private void TendInquiry(SimTime now)
    {
        if (inquiry is null || link is null)
        {
            return;
        }

        if (now - inquiry.Began > Options.Timeout)
        {
            Conclude(inquiry.After, DivergenceFinding.Unanswered);
        }
        else if (inquiry.Due <= now)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.DoubtBytes];
            SimDuration patience = link.Trips.Patience + UpdateLink.MostAckDelay;
            Send(bytes.Slice(0, inquiry.Ask(link.SessionId, Peer, now, patience).Encode(bytes)), link);
        }
    }

    private void OnEvidence(in EvidenceDatagram evidence, int length)
    {
        if (link is null || inquiry is null || evidence.SessionId != link.SessionId || !inquiry.Take(evidence, Clock.Now))
        {
            Counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(length);
        if (!inquiry.IsComplete)
        {
            return;
        }

        if (!inquiry.IsWhole || !Recent.IsWholeAfter(inquiry.After))
        {
            Conclude(inquiry.After, DivergenceFinding.Forgotten);
            return;
        }

        inquiry.Events.Sort(RecentEvents.Compare); // the other's order is not believed
        Compare(inquiry.Events, Recent.Between(inquiry.After, inquiry.UpTo));
    }

    /// <summary>Finds the first event that only one of the two has, or that both have otherwise.</summary>
    private void Compare(List<LogEntry> theirs, List<LogEntry> own)
    {
        SimTime after = inquiry!.After;
        int same = 0;
        while (same < theirs.Count && same < own.Count && theirs[same].Event.Equals(own[same].Event))
        {
            same++;
        }

        LogEntry? hosts = same < theirs.Count ? theirs[same] : null;
        LogEntry? mine = same < own.Count ? own[same] : null;
        if (hosts is null && mine is null)
        {
            Conclude(after, DivergenceFinding.EventsAgree);
        }
        else if (mine is not LogEntry here || (hosts is LogEntry there && RecentEvents.Compare(there, here) <= 0))
        {
            bool isKnown = Recent.TryFind(hosts!.Value.Event, out LogEntry version, out bool hasEffect);
            Conclude(after, DivergenceFinding.EventDiffers, hosts, isKnown ? version : null, hasEffect);
        }
        else
        {
            int at = theirs.FindIndex(e => e.Event.Peer == here.Event.Peer && e.Event.Sequence == here.Event.Sequence);
            Conclude(after, DivergenceFinding.EventDiffers, at < 0 ? null : theirs[at], here, true);
        }
    }

    private void Conclude(SimTime after, DivergenceFinding finding, LogEntry? hosts = null, LogEntry? own = null, bool hasOwnEffect = false)
    {
        inquiry = null;
        Divergence found = Describe(after, finding, hosts, own, hasOwnEffect);
        divergence = found;
        Diverged?.Invoke(found);
        Renew();
    }

    private Divergence Describe(SimTime after, DivergenceFinding finding, LogEntry? hosts = null, LogEntry? own = null, bool hasOwnEffect = false) => new(
        World!.Simulation.Start, after, differing, hostHash, Recent.Between(after, differing.Time), finding, hosts, own, hasOwnEffect);
}
