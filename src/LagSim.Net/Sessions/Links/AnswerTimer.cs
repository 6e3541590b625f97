using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>How long a link waits for the answer to what it sent, and how often in a row none came.</summary>
/// <param name="trips">The link's round trips.</param>
/// <param name="sent">What was sent.</param>
/// <param name="longestDelay">How long the other end may take until it answers.</param>
internal sealed class AnswerTimer(RoundTrips trips, SentDatagrams sent, SimDuration longestDelay)
{
    /// <summary>The longest wait for an answer doubles no more often than this.</summary>
    private const int MostDoublings = 3;

    /// <summary>So many times in a row nothing is answered before the link counts as another one.</summary>
    private const int Silent = 3;

    /// <summary>How long an answer is waited for before a round trip has been measured.</summary>
    private static readonly SimDuration FirstTimeout = SimDuration.FromMilliseconds(300);

    private int unanswered; // how many times in a row answers were overdue
    private SimTime answered; // when something was answered, or began to be waited for

    /// <summary>How long an answer is waited for.</summary>
    internal SimDuration Timeout => (trips.IsMeasured ? trips.Timeout : FirstTimeout) + longestDelay;

    /// <summary>Whether the last answer that was waited for did not come in time.</summary>
    internal bool IsOverdue => unanswered > 0;

    /// <summary>Whether the link is still taken for the one that was measured.</summary>
    internal bool MayBeLate => unanswered < Silent;

    /// <summary>Notes that something was answered.</summary>
    internal void NoteAnswer(SimTime now) => (unanswered, answered) = (0, now);

    /// <summary>Notes that something is about to be sent: if no answer is waited for, the wait begins.</summary>
    internal void NoteSending(SimTime now) => answered = sent.Waited == 0 && unanswered == 0 ? now : answered;

    /// <summary>
    /// Notes that an answer was overdue; true the moment that it has been for so long that the link counts as another one.
    /// </summary>
    internal bool NoteOverdue()
    {
        unanswered = Math.Min(unanswered + 1, MostDoublings + Silent);
        return unanswered == Silent;
    }

    /// <summary>When the answer to what was sent is overdue.</summary>
    internal SimTime Due(SimTime now) => sent.TryPeekOldest(out SimTime at) ? at + (Timeout * (1L << Doublings(now))) : SimTime.MaxValue;

    /// <summary>
    /// How many times the wait for an answer has doubled. Where there is a queue it doubles each time that an answer was overdue. Where
    /// there is none it first does
    /// after eight times the wait, since a link that loses several datagrams in a row is lost for longer the fewer are sent; by then nobody
    /// may be there.
    /// </summary>
    internal int Doublings(SimTime now)
    {
        int doublings = 0;
        while (doublings < MostDoublings && doublings < unanswered && (trips.HasQueue || now - answered > Timeout * (8L << doublings)))
        {
            doublings++;
        }

        return doublings;
    }
}
