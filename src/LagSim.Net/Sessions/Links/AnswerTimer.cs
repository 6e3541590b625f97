using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Tracks how long a link waits for the answer to what it sent, and how often in a row none came.</summary>
/// <param name="trips">The link's round trips.</param>
/// <param name="sent">The datagrams sent.</param>
/// <param name="longestDelay">How long the other end may take to answer.</param>
internal sealed class AnswerTimer(RoundTrips trips, SentDatagrams sent, SimDuration longestDelay)
{
    /// <summary>The limit on how often the longest wait for an answer doubles.</summary>
    private const int MaxDoublings = 3;

    /// <summary>The number of overdue answers in a row after which the link counts as a different one.</summary>
    private const int Silent = 3;

    /// <summary>How long to wait for an answer before a round trip has been measured.</summary>
    private static readonly SimDuration FirstTimeout = SimDuration.FromMilliseconds(300);

    private int unanswered; // the number of overdue answers in a row
    private SimTime answered; // when the last answer arrived, or the wait for one began

    /// <summary>How long to wait for an answer.</summary>
    internal SimDuration Timeout => (trips.IsMeasured ? trips.Timeout : FirstTimeout) + longestDelay;

    /// <summary>Whether the last awaited answer did not arrive in time.</summary>
    internal bool IsOverdue => unanswered > 0;

    /// <summary>Whether the link still counts as the one that was measured.</summary>
    internal bool MayBeLate => unanswered < Silent;

    /// <summary>Records an answer.</summary>
    internal void NoteAnswer(SimTime now) => (unanswered, answered) = (0, now);

    /// <summary>Called before sending: if no answer is awaited, the wait begins.</summary>
    internal void NoteSending(SimTime now) => answered = sent.Waited == 0 && unanswered == 0 ? now : answered;

    /// <summary>Records an overdue answer; true at the moment when so many were overdue that the link counts as a different one.</summary>
    internal bool NoteOverdue()
    {
        unanswered = Math.Min(unanswered + 1, MaxDoublings + Silent);
        return unanswered == Silent;
    }

    /// <summary>When the answer to what was sent is overdue.</summary>
    internal SimTime Due(SimTime now) => sent.TryPeekOldest(out SimTime at) ? at + (Timeout * (1L << Doublings(now))) : SimTime.MaxValue;

    /// <summary>How many times the wait for an answer has doubled.</summary>
    /// <remarks>
    /// With a queue it doubles each time that an answer is overdue. Without one it first doubles after eight times the wait, since a link
    /// that loses several datagrams in a row is lost for longer the fewer are sent; by then the other end may be gone.
    /// </remarks>
    internal int Doublings(SimTime now)
    {
        int doublings = 0;
        while (doublings < MaxDoublings && doublings < unanswered && (trips.HasQueue || now - answered > Timeout * (8L << doublings)))
        {
            doublings++;
        }

        return doublings;
    }
}
