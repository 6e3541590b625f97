using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Takes in what came for a session, one datagram at a time.</summary>
internal interface IDatagramHandler
{
    /// <summary>An update that is well formed.</summary>
    void OnUpdate(UpdateDatagram update, PeerAddress from);

    /// <summary>Anything else of this version of the protocol, not decoded yet.</summary>
    void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from);

    /// <summary>Something of another version of the protocol; of it only what is the same in all may be read.</summary>
    void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from);
}
