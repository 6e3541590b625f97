using System;

namespace LagSim.Timelines;

/// <content>Rings of segments that one event opened.</content>
internal partial class TimelineStore
{
    /// <summary>The next in the ring of segments that one impact opened; itself if it has no other.</summary>
    internal int Together(int segment) => links[segment].Together;

    /// <summary>The newest segments of these bodies were opened by one impact.</summary>
    internal void Join(Span<int> slots)
    {
        for (int i = 0; i < slots.Length; i++)
        {
            links[last[slots[i]]].Together = last[slots[i + 1 == slots.Length ? 0 : i + 1]];
        }
    }
}
