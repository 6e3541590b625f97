using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Whether one peer keeps up with the host's log, or catches up with it: how far behind it is, and how that goes on.</summary>
/// <remarks>
/// One that once kept up, and then is too far behind, has failed. One that starts too far behind, since its copy took long to fetch, has time, as long as it comes nearer from one look
/// to the next.
/// </remarks>
internal sealed class CatchingUp
{
    /// <summary>
    /// How many limits there are from one look to the next: a dip of half the limit, in which nothing comes, is made good in the rest by one that catches up at half the speed at
    /// which time passes.
    /// </summary>
    private const int LimitsToLook = 2;

    /// <summary>
    /// By so much less than time passes it may come nearer. A link that is used to four fifths by what happens now carries what is behind at a fifth of the speed at which it came, and
    /// half of that may be lost or wait.
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
