using System;

namespace LagSim.Timelines;

/// <content>Rings of segments: of those that one impact opened, and of those of one island.</content>
internal sealed partial class TimelineStore
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

    /// <summary>The next in the ring of segments of one island; itself if it has no other.</summary>
    internal int Mate(int segment) => segment < mates.Length ? mates[segment] : segment;

    /// <summary>Makes one island of those of two segments.</summary>
    internal void JoinIslands(int segment, int other)
    {
        if (mates.Length < pieces.Length)
        {
            int known = mates.Length;
            Array.Resize(ref mates, pieces.Length);
            for (int at = known; at < mates.Length; at++)
            {
                mates[at] = at;
            }
        }

        for (int at = mates[segment]; at != segment; at = mates[at])
        {
            if (at == other)
            {
                return;
            }
        }

        (mates[segment], mates[other]) = (mates[other], mates[segment]); // two rings become one
    }

    private void LeaveIsland(int at)
    {
        if (Mate(at) == at)
        {
            return;
        }

        int before = at;
        while (mates[before] != at)
        {
            before = mates[before];
        }

        mates[before] = mates[at];
        mates[at] = at;
    }
}
