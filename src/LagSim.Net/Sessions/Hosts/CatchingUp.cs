using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Tracks whether a peer keeps up with the host's log, or catches up with it.</summary>
/// <remarks>
/// A peer that once kept up and then falls too far behind has failed. One that starts too far behind, because its snapshot took long to
/// download, has time as long as each check finds it closer than the one before.
/// </remarks>
internal sealed class CatchingUp
{
    /// <summary>
    /// The time between checks, in multiples of the limit. A peer that catches up half a second per second thereby makes up for a dip of
    /// half a limit in which nothing arrives.
    /// </summary>
    private const int LimitsToLook = 2;

    /// <summary>
    /// The least progress, as one part in this many of the elapsed time. A link that carries live events with four fifths of its capacity
    /// has a fifth left to catch up, and half of that may be lost or delayed.
    /// </summary>
    private const int Slowest = 10;

    private bool isLooking;
    private bool hasKeptUp;
    private SimDuration lagThen; // at the last check
    private SimTime looked;

    /// <summary>Updates how far behind the peer is; true if that is too far, and it gets no closer.</summary>
    /// <param name="lag">The age of the oldest entry that it has not acknowledged; zero for none.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="limit">How far behind it may be.</param>
    internal bool HasFailed(SimDuration lag, SimTime now, SimDuration limit)
    {
        hasKeptUp |= lag <= limit / 2;
        if (lag <= limit)
        {
            return false;
        }

        if (!isLooking)
        {
            (isLooking, lagThen, looked) = (true, lag, now);
        }

        SimDuration time = now - looked;
        if (hasKeptUp || time < limit * LimitsToLook)
        {
            return hasKeptUp;
        }

        bool comesNearer = lagThen - lag >= time / Slowest;
        (lagThen, looked) = (lag, now);
        return !comesNearer;
    }
}
