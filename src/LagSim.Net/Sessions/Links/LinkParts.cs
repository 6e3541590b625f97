using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Creates the parts of a link that decide what is sent, and when. Tests replace them to check that each is needed.</summary>
internal class LinkParts
{
    /// <summary>Creates the part that chooses the entries of an update.</summary>
    internal virtual SendWindow Window(uint acknowledged) => new(acknowledged);

    /// <summary>Creates the limit on the bytes in flight.</summary>
    internal virtual CongestionControl Congestion() => new();

    /// <summary>Creates the allowance for repetition.</summary>
    internal virtual SpareRate Spare() => new();

    /// <summary>Creates the part that tracks what arrives.</summary>
    internal virtual LinkReceipts Hearing(SimTime now) => new(now);
}
