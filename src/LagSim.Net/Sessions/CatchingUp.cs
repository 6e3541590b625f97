using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Whether one peer keeps up with the host's log, or catches up with it: how far behind it is, and how that goes on.</summary>
internal sealed class CatchingUp
{
    /// <summary>
    /// By so much less than time passes it may catch up. A link that is used to four fifths by what happens now carries what is behind at a fifth of the speed at which it came, and
    /// half of that may be lost or wait.
    /// </summary>
    private const int Slowest = 10;

    private SimDuration least = SimDuration.MaxValue; // how far behind it was when it last came nearer
    private SimTime nearer; // when

    /// <summary>Notes how far behind it is now; true if that is more than the limit and it has come no nearer for as long.</summary>
    /// <param name="lag">How old the oldest entry is that it has not taken in; zero for none.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="limit">How far behind it may be, and for how long it may come no nearer.</param>
    internal bool HasFailed(SimDuration lag, SimTime now, SimDuration limit)
    {
        if (least == SimDuration.MaxValue || lag <= SimDuration.Zero || least - lag >= (now - nearer) / Slowest)
        {
            (least, nearer) = (lag, now);
        }

        return lag > limit && now - nearer > limit;
    }
}
