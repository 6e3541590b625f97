using LagSim.Net.Carriers;

namespace LagSim.Net.Sessions.Links;

/// <summary>The two ends of a link: its session id, the two peers' numbers, and the other's address.</summary>
internal sealed class LinkEnds
{
    internal LinkEnds(ulong sessionId, byte self, byte peer, PeerAddress other)
    {
        SessionId = sessionId;
        Self = self;
        Peer = peer;
        Other = other;
    }

    /// <summary>The session id that every datagram of the link carries.</summary>
    internal ulong SessionId { get; }

    /// <summary>This peer's number; 0 also for a client that has none yet.</summary>
    internal byte Self { get; set; }

    /// <summary>The other's number; 0 also for a client that has none yet.</summary>
    internal byte Peer { get; set; }

    /// <summary>The other's address.</summary>
    internal PeerAddress Other { get; set; }
}
