using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// The least of the durations of the last while, kept as the least of each of two halves: exact to half the while, without a list.
/// </summary>
internal struct WindowedMinimum
{
    private SimDuration former;
    private SimDuration present;
    private SimTime since;
    private bool hasAny;

    /// <summary>The least of at least the last half of the while, and at most all of it; zero before there is one.</summary>
    internal readonly SimDuration Value => former < present ? former : present;

    internal void Add(SimDuration sample, SimTime now, SimDuration window)
    {
        if (!hasAny || now - since > window)
        {
            former = present = sample; // what was before is older than the while
            since = now;
            hasAny = true;
        }
        else if (now - since > window / 2)
        {
            former = present;
            present = sample;
            since += window / 2; // and not now: where samples are seldom, the former half would count for half as long again
        }
        else
        {
            present = sample < present ? sample : present;
        }
    }
}
