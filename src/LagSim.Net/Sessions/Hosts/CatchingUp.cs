using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Whether one peer keeps up with the host's log, or catches up with it: how far behind it is, and how that goes on.</summary>
/// <remarks>
///  A peer that once kept up and then falls too far behind has failed. One that starts too far behind, because its copy took long to
/// request, has time as long as it is nearer at each look than at the one before.
/// </remarks>
internal sealed class CatchingUp
{
    /// <summary>
    ///  The time from one look to the next, in limits: a peer that catches up half a second per second makes good, in the rest of it, a dip
    /// of half a limit in which nothing comes.
    /// </summary>
    private const int LimitsToLook = 2;

    /// <summary>
    ///  One part in so many of the time that passes is the least that it must come nearer. A link of which what happens now takes four
    /// fifths has a fifth left to catch up with, and half of that may be lost or wait.
    /// </summary>
    private const int Slowest = 10;

    private bool isLooking;
    private bool hasKeptUp;
    private SimDuration lagThen; // at the last look
    private SimTime looked;

    /// <summary>Notes how far behind it is now; true if that is too far, and it does not come nearer.</summary>
    /// <param name="lag">How old the oldest entry is that it has not taken in; zero for none.</param>
    /// <param name="now">By the own clock.</param>
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
