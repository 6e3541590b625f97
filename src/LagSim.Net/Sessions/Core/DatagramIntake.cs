using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Tells what kind of datagram came, counts what is none, and hands on the rest.</summary>
/// <remarks>Whoever reads the port calls it: the session itself, or what shares one port among many.</remarks>
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
