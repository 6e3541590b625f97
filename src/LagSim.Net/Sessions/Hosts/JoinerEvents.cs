using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Takes the joiners' events in the order of their numbers, as many a second as each may send; has them judged, applied and recorded.
/// </summary>
internal sealed class JoinerEvents(
    PlayerPlaces places, EventValidator validator, SharedWorld world, ForeignActs acts, AuthoritativeLog log,
    SessionCounters counters)
{
    /// <summary>Judges what a joiner did, in order, as far as it is here.</summary>
    /// <returns>False if something is left for later, because the joiner did too much.</returns>
    internal bool JudgeNext(Joiner joiner, SimTime now)
    {
        while (joiner.Incoming.HasNext)
        {
            if (!places[joiner.Peer].Events.TrySpend(now))
            {
                return false;
            }

            UpdateEntry entry = joiner.Incoming.Take();
            places[joiner.Peer].LastSequence = joiner.EventsReceived;
            Judge(entry, joiner.Peer, joiner.EventsReceived);
        }

        return true;
    }

    private void Judge(in UpdateEntry entry, byte sender, uint sequence)
    {
        ExternalEvent external = entry.Event;
        if (entry.IsOwn || external.Peer != sender || external.Sequence != sequence)
        {
            // In another's name; in the log it would have that other take back what it did itself.
            counters.EventsRefused++;
            counters.EventsForged++;
            return;
        }

        Verdict verdict = validator.Judge(external);
        bool hasEffect = false;
        if (verdict == Verdict.Accepted)
        {
            world.Limits.Note(external);
            acts.Note(external);
            hasEffect = world.Apply(external);
        }

        log.Record(external, verdict, hasEffect);
    }
}
