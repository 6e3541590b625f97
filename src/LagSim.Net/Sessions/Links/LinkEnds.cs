using LagSim.Net.Carriers;

namespace LagSim.Net.Sessions.Links;

/// <summary>Whom a link joins: its number, the two peers' numbers, and where the other one is.</summary>
internal sealed class LinkEnds
{
    internal LinkEnds(ulong sessionId, byte self, byte peer, PeerAddress other)
    {
        SessionId = sessionId;
        Self = self;
        Peer = peer;
        Other = other;
    }

    /// <summary>What every datagram of the link bears.</summary>
    internal ulong SessionId { get; }

    /// <summary>This peer's number; 0 also for a client that has none yet.</summary>
    internal byte Self { get; set; }

    /// <summary>The other's number; 0 also for a client that has none yet.</summary>
    internal byte Peer { get; set; }

    /// <summary>Where the other is.</summary>
    internal PeerAddress Other { get; set; }
}
