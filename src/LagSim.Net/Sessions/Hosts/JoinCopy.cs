using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>What somebody who comes in fetches: scene and world as they were committed, and how much of the log is in them.</summary>
internal sealed class JoinCopy
{
    internal JoinCopy(byte[] bytes, uint logIndex, SimTime made)
    {
        Bytes = bytes;
        Hash = WorldCopy.HashOf(bytes);
        LogIndex = logIndex;
        Made = made;
    }

    internal byte[] Bytes { get; }

    internal ulong Hash { get; }

    /// <summary>How many entries of the log are in it, or can be left out for another reason.</summary>
    internal uint LogIndex { get; }

    internal SimTime Made { get; }
}
