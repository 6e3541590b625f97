using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>The new entries for the other end of a link that have not been sent yet: how much, and since when.</summary>
internal sealed class UnsentEntries
{
    /// <summary>The size of the entries, in bytes.</summary>
    internal int Bytes { get; private set; }

    /// <summary>Since when something waits; the latest instant if nothing does.</summary>
    internal SimTime Since { get; private set; } = SimTime.MaxValue;

    internal void Note(int bytes, SimTime now)
    {
        Bytes += bytes;
        Since = SimTime.Min(Since, now);
    }

    /// <summary>Called when all of it was sent.</summary>
    internal void Clear() => (Bytes, Since) = (0, SimTime.MaxValue);
}
