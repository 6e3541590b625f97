using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>A snapshot for joining clients: the committed scene and world, and how much of the log they include.</summary>
internal sealed class JoinSnapshot
{
    internal JoinSnapshot(byte[] bytes, uint logIndex, SimTime made)
    {
        Bytes = bytes;
        Hash = SessionSnapshot.HashOf(bytes);
        LogIndex = logIndex;
        Made = made;
    }

    internal byte[] Bytes { get; }

    internal ulong Hash { get; }

    /// <summary>The number of log entries that it includes, or that can be left out for another reason.</summary>
    internal uint LogIndex { get; }

    internal SimTime Made { get; }
}
