using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Makes the parts of a link that say what goes out, and when. A test hands in others to see each missed.</summary>
internal class LinkParts
{
    /// <summary>What chooses the entries of an update.</summary>
    internal virtual SendWindow Window(uint acknowledged) => new(acknowledged);

    /// <summary>What says how much may be on its way.</summary>
    internal virtual CongestionControl Congestion() => new();

    /// <summary>What says how much may be repeated.</summary>
    internal virtual SpareRate Spare() => new();

    /// <summary>What takes round trips of what is heard.</summary>
    internal virtual LinkHearing Hearing(SimTime now) => new(now);
}
