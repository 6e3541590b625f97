using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>What a link has on its way: what is acknowledged, what is known to be lost, and how much more may go.</summary>
internal sealed class LinkFlight
{
    private readonly RoundTrips trips;
    private readonly SpareRate spare;
    private readonly AnswerTimer answers;

    /// <param name="window">The entries.</param>
    /// <param name="sent">The datagrams.</param>
    /// <param name="congestion">How many of them may be on their way.</param>
    /// <param name="trips">The link's round trips.</param>
    /// <param name="spare">What a loss leaves less of for repetition.</param>
    /// <param name="answers">What is told of every answer.</param>
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

    /// <summary>What of this peer's entries goes out next.</summary>
    internal SendWindow Window { get; }

    internal SentDatagrams Sent { get; }

    internal CongestionControl Congestion { get; }

    /// <summary>How long what was sent after it takes to come at most, if it comes.</summary>
    internal SimDuration LongestTrip => trips.Mean > trips.Newest ? trips.Mean : trips.Newest;

    /// <summary>Notes that an update was sent.</summary>
    /// <param name="update">The update.</param>
    /// <param name="length">Its length, in bytes.</param>
    /// <param name="now">By the own clock.</param>
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
    }

    /// <summary>Notes that the other has this peer's entries up to a number.</summary>
    internal void Acknowledge(uint number, SimTime now)
    {
        Window.Acknowledge(number);
        while (Sent.TryTakeCovered(Window.Acknowledged, out SentDatagrams.Datagram covered))
        {
            NoteCame(covered, now);
        }
    }

    /// <summary>Takes what an update says of those that came: the newest, and which of the 32 before it.</summary>
    internal void TakeAcknowledgements(UpdateDatagram update, SimTime now)
    {
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

    /// <summary>Notes what is known to be lost, since what was sent after it came.</summary>
    internal void TakeLost(SimTime now)
    {
        while (Sent.TryTakeLost(now, LongestTrip, out SentDatagrams.Datagram datagram))
        {
            Lose(datagram, now, trips.HasQueue);
        }
    }

    /// <summary>Notes that the answer to what was sent is overdue: it counts as lost from now on.</summary>
    /// <returns>Whether what goes in its place is a probe, which the window does not hold back.</returns>
    internal bool TakeOverdue(SimTime now)
    {
        if (answers.NoteOverdue() && trips.HasQueue)
        {
            Congestion.OnSilence(now);
        }

        // With a queue on the way the answer is more likely late than lost. So twice only the oldest goes again, as a probe that the window
        // does not hold back
        // (RFC 9002, 6.2.4 and 7.5); then all that is overdue is lost, and what goes is what the least window lets (7.6).
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
            spare.Cut(); // where none shows, repetition is what hides losses
        }

        Sent.NoteLost(datagram);
        Window.Lose(datagram.First, datagram.Last, isOnItsWay: Sent.IsCarriedLater(datagram, datagram.First, datagram.Last));
    }
}
