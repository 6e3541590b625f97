using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// Follows the host's log at a client: takes its lines in order, has others' accepted events happen and own refused ones not have happened,
/// and commits.
/// </summary>
internal sealed class LogFollower(
    HostConnection connection, SharedWorld world, CommitTracker commits, EventJournal journal, PlayerIdentity self,
    SharedClock sharedTime, SessionCounters counters, IClock clock)
{
    /// <summary>Keeps what an update brought until its turn comes.</summary>
    internal void Keep(UpdateDatagram update)
    {
        uint number = update.FirstIndex;
        foreach (UpdateEntry entry in update.Held)
        {
            connection.Log.Put(number++, entry); // what is too far ahead comes again
        }

        if (update.Watermark != SimTime.MinValue && number > 0)
        {
            connection.Log.Promise(number - 1, update.Watermark);
        }
    }

    /// <summary>Takes what has come, in order; false if there is nothing.</summary>
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
            // What is not validated yet, or still to be done, may have to be taken back, and for that its history must be there. Own stamps
            // never go back. That the host has an event is not enough: an older update may come between that and its verdict.
            SimTime needed = connection.Unconfirmed.Count > 0 ? connection.Unconfirmed.Oldest.Time : sharedTime.Now;
            commits.Commit(SimTime.Min(incoming.Promised, needed));
        }

        // What was committed may have differed: then this peer has left the link for a fresh copy.
        if (!any || connection.Link is not UpdateLink link)
        {
            return any;
        }

        if (isUrgent)
        {
            link.Answer(now);
        }
        else
        {
            link.Flush(now + UpdateLink.MostAckDelay);
        }

        return true;
    }

    private void Take(in UpdateEntry entry, uint number)
    {
        bool own = entry.IsOwn;
        ExternalEvent external = entry.Event;
        OwnEvents unconfirmed = connection.Unconfirmed;
        bool isAnothers = !own && (external.Peer != self.Number || external.Sequence <= connection.FirstSequence);
        bool isNextOwn = own && unconfirmed.Count > 0 && unconfirmed.Oldest.Sequence == entry.Sequence;
        if (!isAnothers && !isNextOwn)
        {
            counters.EventsForged++; // a host that rules on what this peer did not do, or not in order, is none of ours
            return;
        }

        external = own ? connection.TakeConfirmed(clock.Now) : external;
        bool accepted = entry.Verdict == Verdict.Accepted && (own || world.MayEnter(external));
        bool hasEffect = accepted;
        counters.EventsAccepted += accepted ? 1 : 0;
        counters.EventsRefused += accepted ? 0 : 1;
        if (own && !accepted)
        {
            world.Retract(external);
        }
        else if (!own && accepted && external.Time >= world.From)
        {
            world.Limits.Note(external);
            hasEffect = world.Apply(external);
        }

        journal.Tell(new LogEntry(number, entry.Verdict, external), hasEffect);
    }
}
