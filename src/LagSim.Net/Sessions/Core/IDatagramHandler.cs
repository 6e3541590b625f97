using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Handles the datagrams of a session, one at a time.</summary>
internal interface IDatagramHandler
{
    /// <summary>Handles a well-formed update.</summary>
    void OnUpdate(UpdateDatagram update, PeerAddress from);

    /// <summary>Handles any other datagram of this protocol version, not decoded yet.</summary>
    void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from);

    /// <summary>Handles a datagram of another protocol version; only the fields common to all versions may be read.</summary>
    void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from);
}
