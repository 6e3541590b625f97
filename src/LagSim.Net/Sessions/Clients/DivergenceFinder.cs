using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Finds out of a committed state that is not the host's since when, and which event makes the difference.</summary>
internal sealed class DivergenceFinder(
    HostConnection connection, SharedWorld world, EventJournal journal, PlayerIdentity self, DatagramSender sender,
    SessionCounters counters, IClock clock, SimDuration timeout)
{
    private Inquiry? inquiry;
    // The newest committed time at which the states were the same, before the first at which they were not.
    private SimTime agreed = SimTime.MinValue;
    private CommittedState differing;
    private ulong hostHash;
    private volatile Divergence? divergence;

    /// <summary>Raised once, when it is found out what the first differing state comes from, or that this cannot be.</summary>
    internal event Action<Divergence>? Found;

    /// <summary>Raised after that, and for every later state that differs: what is known to be wrong is not gone on with.</summary>
    internal event Action? Confirmed;

    /// <summary>The first state that differed, and what is known of it by now; null while there is none. From any thread.</summary>
    internal Divergence? First => divergence;

    /// <summary>When the host is to be asked next.</summary>
    internal SimTime Due => inquiry?.Due ?? SimTime.MaxValue;

    /// <summary>Starts anew with another world. That one was wrong stays known.</summary>
    internal void Reset() => agreed = SimTime.MinValue;

    /// <summary>Asks no more.</summary>
    internal void Cancel() => inquiry = null;

    /// <summary>An own committed state was held against the hash that the host told for it.</summary>
    internal void OnCompared(CommittedState own, ulong theirs)
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
                Confirmed?.Invoke();
            }

            return;
        }

        (differing, hostHash) = (own, theirs);
        SimTime begun = (world.BegunFrom?.Time ?? world.Live!.Simulation.Start) - SimDuration.OneTick;
        SimTime after = agreed == SimTime.MinValue || agreed >= own.Time ? begun : agreed;
        if (!world.PromisesAgreement || !journal.Recent.IsWholeAfter(after))
        {
            Conclude(after, world.PromisesAgreement ? DivergenceFinding.Forgotten : DivergenceFinding.NotPromised);
            return;
        }

        inquiry = new Inquiry(after, own.Time, clock.Now);
        divergence = Describe(after, DivergenceFinding.Asking);
    }

    /// <summary>Asks the host if it is time to.</summary>
    internal void Tend(SimTime now)
    {
        if (inquiry is null || connection.Link is not UpdateLink link)
        {
            return;
        }

        if (now - inquiry.Began > timeout)
        {
            Conclude(inquiry.After, DivergenceFinding.Unanswered);
        }
        else if (inquiry.Due <= now)
        {
            Span<byte> bytes = stackalloc byte[WireFormat.DesyncQueryBytes];
            SimDuration timeout = link.Trips.Timeout + UpdateLink.MostAckDelay;
            sender.Send(bytes.Slice(0, inquiry.Ask(link.SessionId, self.Number, now, timeout).Encode(bytes)), link);
        }
    }

    internal void OnDesyncReport(in DesyncReportDatagram report, int length)
    {
        if (connection.Link is not UpdateLink link || inquiry is null || report.SessionId != link.SessionId
            || !inquiry.Take(report, clock.Now))
        {
            counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(length);
        if (!inquiry.IsComplete)
        {
            return;
        }

        if (!inquiry.IsWhole || !journal.Recent.IsWholeAfter(inquiry.After))
        {
            Conclude(inquiry.After, DivergenceFinding.Forgotten);
            return;
        }

        List<LogEntry> theirs = inquiry.Events;
        theirs.Sort(RecentEvents.Compare); // the other's order is not believed
        EventDifference first = EventDifference.First(theirs, journal.Recent.Between(inquiry.After, inquiry.UpTo), journal.Recent);
        Conclude(inquiry.After, first.IsNone ? DivergenceFinding.EventsAgree : DivergenceFinding.EventDiffers, first);
    }

    private void Conclude(SimTime after, DivergenceFinding finding, EventDifference first = default)
    {
        inquiry = null;
        Divergence found = Describe(after, finding, first);
        divergence = found;
        Found?.Invoke(found);
        Confirmed?.Invoke();
    }

    private Divergence Describe(SimTime after, DivergenceFinding finding, EventDifference first = default) => new(
        world.Live!.Simulation.Start, after, differing, hostHash, journal.Recent.Between(after, differing.Time), finding,
        first.Hosts, first.Own, first.HasOwnEffect);
}
