using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// How long a link may rest: until the keep-alive, or less where the other end has not been heard when it should have been.
/// </summary>
internal sealed class KeepAlivePolicy
{
    private readonly SimDuration resendInterval;

    internal KeepAlivePolicy(SimDuration keepAlive, SimDuration resendInterval)
    {
        KeepAlive = keepAlive;
        this.resendInterval = resendInterval;
    }

    /// <summary>How long nothing is sent at most.</summary>
    internal SimDuration KeepAlive { get; }

    /// <summary>
    /// How long a silence is overdue. A host waits as long before it writes of itself: a client's keep-alives, which it answers, do for
    /// both.
    /// </summary>
    internal SimDuration Overdue => KeepAlive + (KeepAlive / 4);

    /// <summary>
    /// Whether one end of a link has not heard of the other when it should have. They then write as if something were unacknowledged: else
    /// a
    /// burst of losses, which is counted in datagrams, would last as long as the timeout.
    /// </summary>
    internal bool IsOverdue(SimDuration silence) => silence > Overdue;

    /// <summary>How long after an update the next one goes out if nothing new comes up.</summary>
    /// <param name="link">To whom.</param>
    /// <param name="isWaitedFor">Whether the other must hear of something that is no entry.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="atRest">How long where nothing is the matter.</param>
    internal SimDuration RestAfterUpdate(UpdateLink link, bool isWaitedFor, SimTime now, SimDuration atRest)
    {
        if (!isWaitedFor && !IsOverdue(link.Silence(now)))
        {
            return atRest;
        }

        return link.Trips.HasQueue && link.Trips.Mean > resendInterval ? link.Trips.Mean : resendInterval;
    }
}
