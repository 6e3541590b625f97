using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Takes the clients' events in order, at most as many per second as each may send, and has them validated, applied and recorded.
/// </summary>
internal sealed class ClientEvents(
    PlayerPlaces places, EventValidator validator, SharedWorld world, SharedClock sharedTime, RecentTouches acts, AuthoritativeLog log,
    SessionCounters counters)
{
    /// <summary>Validates a client's events that have arrived, in order.</summary>
    /// <returns>False if some are deferred because the client sent too many.</returns>
    internal bool ValidateNext(Client client, SimTime now)
    {
        while (client.Incoming.HasNext)
        {
            if (!places[client.Peer].Events.TrySpend(now))
            {
                return false;
            }

            UpdateEntry entry = client.Incoming.Take();
            places[client.Peer].LastSequence = client.EventsReceived;
            Validate(entry, client);
            client.Stamps.Promised = client.Incoming.Promised; // not before: the event itself may be stamped earlier
        }

        client.Stamps.Promised = client.Incoming.Promised;
        return true;
    }

    private void Validate(in UpdateEntry entry, Client client)
    {
        ExternalEvent external = entry.Event;
        if (entry.IsOwn || external.Peer != client.Peer || external.Sequence != client.EventsReceived)
        {
            // Sent in another player's name; in the log it would make that player retract its own event.
            counters.EventsRefused++;
            counters.EventsForged++;
            return;
        }

        Verdict verdict = validator.Validate(ref external, client.Stamps);
        if (verdict.IsAcceptance() || verdict == Verdict.TooLate)
        {
            client.Stamps.Acted = sharedTime.Now; // late ones too: who is too late once would else be too late for good
        }

        bool hasEffect = false;
        if (verdict.IsAcceptance())
        {
            client.Stamps.Note(external.Time, isMoved: verdict == Verdict.Moved);
            world.Limits.Note(external);
            acts.Note(external);
            hasEffect = world.Apply(external);
        }

        log.Record(external, verdict, hasEffect);
    }
}
