using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// Follows the host's log on a client: takes its entries in order, applies accepted events of other peers, retracts own events that were
/// refused, moves those that happen later, and commits.
/// </summary>
internal sealed class LogFollower(
    HostConnection connection, SharedWorld world, CommitTracker commits, EventJournal journal, PlayerIdentity self,
    SharedClock sharedTime, SessionCounters counters, IClock clock)
{
    /// <summary>Buffers the entries of an update until their turn comes.</summary>
    internal void Keep(UpdateDatagram update)
    {
        uint number = update.FirstIndex;
        foreach (UpdateEntry entry in update.Held)
        {
            connection.Log.Put(number++, entry); // an entry too far ahead is sent again
        }

        if (update.Watermark != SimTime.MinValue && number > 0)
        {
            connection.Log.Promise(number - 1, update.Watermark);
        }
    }

    /// <summary>Takes the entries that have arrived, in order; false if there are none.</summary>
    internal bool TakeEntries(SimTime now)
    {
        ReceiveWindow incoming = connection.Log;
        bool any = incoming.HasNext;
        bool isUrgent = false;
        while (incoming.HasNext)
        {
            UpdateEntry entry = incoming.Take();
            isUrgent |= entry.IsOwn ? entry.Sequence <= connection.LastUrgent || entry.Verdict != Verdict.Accepted
                : !SendWindow.IsMadeUpFor(entry.Event);
            Take(entry, incoming.Received);
        }

        if (incoming.Promised != SimTime.MinValue)
        {
            // An event that is not validated yet, or not stamped yet, may have to be retracted, and that needs its history. Own stamps
            // never go back. That the host has received an event is not enough: an older update may arrive before the one with its verdict.
            SimTime needed = connection.Unconfirmed.Count > 0 ? connection.Unconfirmed.Oldest.Time : sharedTime.Now;
            commits.Commit(SimTime.Min(incoming.Promised, needed));
        }

        // A committed state may have differed; then this peer has left the link to get a fresh snapshot.
        if (!any || connection.Link is not UpdateLink link)
        {
            return any;
        }

        if (isUrgent)
        {
            link.AnswerSoon(now);
        }
        else
        {
            link.Flush(now + UpdateLink.MaxAckDelay);
        }

        return true;
    }

    private void Take(in UpdateEntry entry, uint number)
    {
        ExternalEvent external = entry.Event;
        OwnEvents unconfirmed = connection.Unconfirmed;
        bool isAnothers = !entry.IsOwn && (external.Peer != self.Number || external.Sequence <= connection.FirstSequence);
        bool own = entry.IsOwn || (!isAnothers && entry.Verdict == Verdict.Moved);
        bool isNextOwn = own && entry.IsOwn == (entry.Verdict != Verdict.Moved) && unconfirmed.Count > 0
            && unconfirmed.Oldest.Sequence == entry.Sequence;
        if (!isAnothers && !isNextOwn)
        {
            counters.EventsForged++; // verdicts on events this peer never sent, or out of order, do not come from our host
            return;
        }

        ExternalEvent done = own ? connection.TakeConfirmed(clock.Now) : external;
        external = entry.IsOwn ? done : external;
        bool accepted = entry.Verdict.IsAcceptance() && (entry.IsOwn || world.MayEnter(external));
        bool hasEffect = accepted;
        counters.EventsAccepted += accepted ? 1 : 0;
        counters.EventsRefused += accepted ? 0 : 1;
        counters.EventsMoved += accepted && entry.Verdict == Verdict.Moved ? 1 : 0;
        if (own && !accepted)
        {
            world.Retract(done);
        }
        else if (own && entry.Verdict == Verdict.Moved)
        {
            hasEffect = world.Move(done, external);
        }
        else if (!own && accepted && external.Time >= world.From)
        {
            world.Limits.Note(external);
            hasEffect = world.Apply(external);
        }

        journal.Tell(new LogEntry(number, entry.Verdict, external), hasEffect);
    }
}
