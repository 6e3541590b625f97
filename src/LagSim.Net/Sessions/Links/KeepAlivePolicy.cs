using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Decides how long a link may rest: until the keep-alive, or less if the other end has been silent for too long.</summary>
internal sealed class KeepAlivePolicy
{
    private readonly SimDuration resendInterval;

    internal KeepAlivePolicy(SimDuration keepAlive, SimDuration resendInterval)
    {
        KeepAlive = keepAlive;
        this.resendInterval = resendInterval;
    }

    /// <summary>The longest pause between datagrams.</summary>
    internal SimDuration KeepAlive { get; }

    /// <summary>
    /// The silence after which the other end is overdue. A host waits as long before it sends on its own: a client's keep-alives, which it
    /// answers, serve both directions.
    /// </summary>
    internal SimDuration Overdue => KeepAlive + (KeepAlive / 4);

    /// <summary>Whether the other end of a link is overdue.</summary>
    /// <remarks>
    /// Each end then sends as if something were unacknowledged. Otherwise a burst of losses, which is counted in datagrams, would last as
    /// long as the timeout.
    /// </remarks>
    internal bool IsOverdue(SimDuration silence) => silence > Overdue;

    /// <summary>How long after an update the next one is sent if nothing new comes up.</summary>
    /// <param name="link">The link.</param>
    /// <param name="isWaitedFor">Whether the other end waits for something that is not an entry.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="atRest">The pause when nothing is wrong.</param>
    internal SimDuration RestAfterUpdate(UpdateLink link, bool isWaitedFor, SimTime now, SimDuration atRest)
    {
        if (!isWaitedFor && !IsOverdue(link.Silence(now)))
        {
            return atRest;
        }

        return link.Trips.HasQueue && link.Trips.Mean > resendInterval ? link.Trips.Mean : resendInterval;
    }
}
