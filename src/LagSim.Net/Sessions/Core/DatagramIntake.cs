using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Classifies incoming datagrams, counts the malformed ones, and passes the rest on.</summary>
/// <remarks>Called by the reader of the port: the session itself, or a dispatcher that shares one port among many.</remarks>
internal sealed class DatagramIntake(SessionCounters counters, IDatagramHandler handler)
{
    private readonly UpdateDatagram received = new();

    internal void Take(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        counters.DatagramsReceived++;
        if (!WireFormat.TryReadType(datagram, out DatagramType type, out WireRefusal refusal))
        {
            counters.DatagramsMalformed++;
            if (refusal == WireRefusal.VersionDiffers)
            {
                handler.OnOtherVersion(datagram, from);
            }
        }
        else if (type != DatagramType.Update)
        {
            handler.OnDatagram(type, datagram, from);
        }
        else if (received.TryDecode(datagram, out _))
        {
            handler.OnUpdate(received, from);
        }
        else
        {
            counters.DatagramsMalformed++;
        }
    }
}
