using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>The minimum over a sliding window, kept as the minima of its two halves: exact to half the window, without a list.</summary>
internal struct WindowedMinimum
{
    private SimDuration former;
    private SimDuration present;
    private SimTime since;
    private bool hasAny;

    /// <summary>The minimum of at least the last half of the window, and at most all of it; zero before there is one.</summary>
    internal readonly SimDuration Value => former < present ? former : present;

    internal void Add(SimDuration sample, SimTime now, SimDuration window)
    {
        if (!hasAny || now - since > window)
        {
            former = present = sample; // everything before is older than the window
            since = now;
            hasAny = true;
        }
        else if (now - since > window / 2)
        {
            former = present;
            present = sample;
            // Advanced by halves: setting it to now would let the former half count half a window longer where samples are rare.
            since += window / 2;
        }
        else
        {
            present = sample < present ? sample : present;
        }
    }
}
