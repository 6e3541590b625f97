using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Handles the datagrams of a session, one at a time.</summary>
internal interface IDatagramHandler
{
    /// <summary>Returns what protects the link with that session id; null if there is no such link.</summary>
    LinkSeal? SealOf(ulong sessionId);

    /// <summary>Handles a well-formed update. In a protected session it was sealed by the other end of its link.</summary>
    void OnUpdate(UpdateDatagram update, PeerAddress from);

    /// <summary>Handles any other datagram of this protocol version, not decoded yet.</summary>
    /// <param name="type">Its type; not one of a sealed datagram.</param>
    /// <param name="datagram">The datagram; what it sealed, if it was.</param>
    /// <param name="from">Where it came from.</param>
    /// <param name="isSealed">
    /// Whether it was sealed by the other end of its link. In a protected session only what belongs to no link arrives unsealed.
    /// </param>
    void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from, bool isSealed);

    /// <summary>Handles a sealed datagram of a session without a link.</summary>
    void OnStrayDatagram(ulong sessionId, PeerAddress from);

    /// <summary>Handles a datagram of another protocol version; only the fields common to all versions may be read.</summary>
    void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from);
}
