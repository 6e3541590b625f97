using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>The two ends of a link: its session id, the two peers' numbers, the other's address, and what protects it.</summary>
internal sealed class LinkEnds
{
    internal LinkEnds(ulong sessionId, PeerAddress other, LinkSeal? seal = null)
    {
        SessionId = sessionId;
        Other = other;
        Seal = seal;
    }

    /// <summary>The session id that every datagram of the link carries.</summary>
    internal ulong SessionId { get; }

    /// <summary>This peer's number; 0 also for a client that has none yet.</summary>
    internal byte Self { get; set; }

    /// <summary>The other's number; 0 also for a client that has none yet.</summary>
    internal byte Peer { get; set; }

    /// <summary>The other's address.</summary>
    internal PeerAddress Other { get; set; }

    /// <summary>Seals the link's datagrams; null in a session without protection.</summary>
    internal LinkSeal? Seal { get; }

    /// <summary>How much longer a datagram is on this link than without protection.</summary>
    internal int SealBytes => Seal is null ? 0 : WireFormat.SealBytes;
}
