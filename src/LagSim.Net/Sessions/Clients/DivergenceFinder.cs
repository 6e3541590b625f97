using System;
using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>Finds out since when a committed state differs from the host's, and which event makes the difference.</summary>
internal sealed class DivergenceFinder(
    HostConnection connection, SharedWorld world, EventJournal journal, PlayerIdentity self, DatagramSender sender,
    SessionCounters counters, IClock clock, SimDuration timeout)
{
    private DesyncQuery? inquiry;
    // The newest committed time at which the states still agreed.
    private SimTime agreed = SimTime.MinValue;
    private CommittedState differing;
    private ulong hostHash;
    private volatile Divergence? divergence;

    /// <summary>Raised once, when the cause of the first differing state is known, or known to be out of reach.</summary>
    internal event Action<Divergence>? Found;

    /// <summary>
    /// Raised after <see cref="Found"/>, and again for every later state that differs, because a world known to be wrong is abandoned.
    /// </summary>
    internal event Action? Confirmed;

    /// <summary>The first state that differed, with what is known about it so far; null while there is none. From any thread.</summary>
    internal Divergence? First => divergence;

    /// <summary>When to send the next query to the host.</summary>
    internal SimTime Due => inquiry?.Due ?? SimTime.MaxValue;

    /// <summary>Starts over with another world. <see cref="First"/> is kept.</summary>
    internal void Reset() => agreed = SimTime.MinValue;

    /// <summary>Stops querying.</summary>
    internal void Cancel() => inquiry = null;

    /// <summary>Called when an own committed state has been compared with the hash that the host reported.</summary>
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

        inquiry = new DesyncQuery(after, own.Time, clock.Now);
        divergence = Describe(after, DivergenceFinding.Asking);
    }

    /// <summary>Queries the host if it is time to.</summary>
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
            SimDuration timeout = link.Trips.Timeout + UpdateLink.MaxAckDelay;
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
        theirs.Sort(RecentEvents.Compare); // the order in which the host sent them is not trusted
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
