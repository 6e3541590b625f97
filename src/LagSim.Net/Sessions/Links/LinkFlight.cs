using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>The datagrams in flight on a link: which are acknowledged, which are lost, and how much more may be sent.</summary>
internal sealed class LinkFlight
{
    private readonly RoundTrips trips;
    private readonly SpareRate spare;
    private readonly AnswerTimer answers;
    private readonly EntryCopies copies = new();
    private uint newest; // the newest entry that was sent

    /// <param name="window">The entries.</param>
    /// <param name="sent">The datagrams.</param>
    /// <param name="congestion">The limit on the bytes in flight.</param>
    /// <param name="trips">The link's round trips.</param>
    /// <param name="spare">The allowance for repetition, which a loss cuts.</param>
    /// <param name="answers">Notified of every answer.</param>
    internal LinkFlight(
        SendWindow window, SentDatagrams sent, CongestionControl congestion, RoundTrips trips, SpareRate spare, AnswerTimer answers)
    {
        Window = window;
        Sent = sent;
        Congestion = congestion;
        this.trips = trips;
        this.spare = spare;
        this.answers = answers;
    }

    /// <summary>Chooses which of this peer's entries are sent next.</summary>
    internal SendWindow Window { get; }

    internal SentDatagrams Sent { get; }

    internal CongestionControl Congestion { get; }

    /// <summary>How long a datagram may be.</summary>
    internal PathSize Path { get; } = new();

    /// <summary>In how many updates in a row an entry goes.</summary>
    internal int Copies => copies.Count(trips.IsMeasured ? LongestTrip + UpdateLink.AnswerDelay : answers.Timeout);

    /// <summary>How long entries wait before they go again for lack of new ones, at an interval of the session.</summary>
    internal SimDuration RepeatDelay(SimDuration interval) => copies.RepeatDelay(interval);

    /// <summary>The longest time for the answer to a datagram sent later, if it arrives.</summary>
    internal SimDuration LongestTrip => trips.Mean > trips.Newest ? trips.Mean : trips.Newest;

    /// <summary>Records that an update was sent.</summary>
    /// <param name="update">The update.</param>
    /// <param name="length">Its length on this link, in bytes.</param>
    /// <param name="now">The time by the local clock.</param>
    internal void NoteSent(UpdateDatagram update, int length, SimTime now)
    {
        answers.NoteSending(now);
        uint last = update.FirstIndex + (uint)update.Held.Length - 1;
        int bytes = length + CongestionControl.DatagramOverhead;
        if (Sent.Add(update.Number, now, bytes, update.FirstIndex, last) is SentDatagrams.Datagram forgotten)
        {
            Lose(forgotten, now, trips.HasQueue);
        }

        if (update.Held.Length > 0)
        {
            Congestion.OnSent(bytes);
        }

        if (last > newest && update.Held.Length > 0)
        {
            newest = last;
            copies.NoteSent(now);
        }
    }

    /// <summary>Records that the other has this peer's entries up to a number.</summary>
    internal void Acknowledge(uint number, SimTime now)
    {
        Window.Acknowledge(number);
        while (Sent.TryTakeCovered(Window.Acknowledged, out SentDatagrams.Datagram covered))
        {
            NoteCame(covered, now);
        }
    }

    /// <summary>Takes the acknowledgements of an update: the newest received, and which of the 32 before it.</summary>
    internal void TakeAcknowledgements(UpdateDatagram update, SimTime now)
    {
        copies.NoteArrived(update);
        AcknowledgeUpdate(update.EchoNumber, now);
        for (int n = 0; n < 32 && update.EchoBits >> n != 0; n++)
        {
            if ((update.EchoBits >> n & 1) != 0)
            {
                AcknowledgeUpdate(update.EchoNumber - 1 - (uint)n, now);
            }
        }

        TakeLost(now);
    }

    /// <summary>Takes datagrams as lost if later ones have arrived.</summary>
    internal void TakeLost(SimTime now)
    {
        while (Sent.TryTakeLost(now, LongestTrip, out SentDatagrams.Datagram datagram))
        {
            Lose(datagram, now, trips.HasQueue);
            if (!trips.HasQueue)
            {
                Path.NoteLost(datagram.Number, datagram.Bytes);
            }
        }
    }

    /// <summary>Takes what was sent as lost, because its answer is overdue.</summary>
    /// <returns>Whether the replacement is a probe, which the window does not hold back.</returns>
    internal bool TakeOverdue(SimTime now)
    {
        if (answers.NoteOverdue() && trips.HasQueue)
        {
            Congestion.OnSilence(now);
        }

        // With a queue the answer is more likely late than lost. So twice only the oldest is sent again, as a probe that the window does
        // not hold back (RFC 9002, 6.2.4 and 7.5); then all that is overdue is lost, and the least window limits what is sent (7.6).
        SimTime before = now - answers.Timeout;
        bool isProbe = trips.HasQueue && answers.MayBeLate;
        while (Sent.TryPeekOldest(out SimTime at) && at <= before && Sent.TryTakeOldest(out SentDatagrams.Datagram oldest))
        {
            Lose(oldest, now, hasQueue: false);
            if (isProbe)
            {
                break;
            }
        }

        return isProbe;
    }

    private void AcknowledgeUpdate(uint number, SimTime now)
    {
        if (Sent.TryAcknowledge(number, out SentDatagrams.Datagram came))
        {
            Path.NoteArrived(came.Number, came.Bytes);
            NoteCame(came, now);
        }
    }

    private void NoteCame(in SentDatagrams.Datagram datagram, SimTime now)
    {
        Congestion.OnAcknowledged(datagram.Bytes, trips.HasQueue);
        answers.NoteAnswer(now);
    }

    private void Lose(in SentDatagrams.Datagram datagram, SimTime now, bool hasQueue)
    {
        if (Congestion.OnLost(datagram.Bytes, datagram.At, now, hasQueue) && trips.HasQueue)
        {
            spare.Cut(); // without a queue, repetition is what hides losses
        }

        Sent.NoteLost(datagram);
        Window.Lose(datagram.First, datagram.Last, isOnItsWay: Sent.IsCarriedLater(datagram, datagram.First, datagram.Last));
    }
}
