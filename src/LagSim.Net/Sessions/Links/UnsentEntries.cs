using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>What is new for the other end of a link and has not gone yet: how much, and since when.</summary>
internal sealed class UnsentEntries
{
    /// <summary>How much, in bytes of entries.</summary>
    internal int Bytes { get; private set; }

    /// <summary>Since when something waits; the latest instant if nothing does.</summary>
    internal SimTime Since { get; private set; } = SimTime.MaxValue;

    internal void Note(int bytes, SimTime now)
    {
        Bytes += bytes;
        Since = SimTime.Min(Since, now);
    }

    /// <summary>All of it has gone.</summary>
    internal void Clear() => (Bytes, Since) = (0, SimTime.MaxValue);
}
