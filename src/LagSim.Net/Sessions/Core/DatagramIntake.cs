using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Classifies incoming datagrams, opens the sealed ones, counts those that are malformed or forged, and passes the rest on.
/// </summary>
/// <remarks>
/// Called by the reader of the port: the session itself, or a dispatcher that shares one port among many. In a protected session nothing
/// that belongs to a link gets past here unless the link's other end sealed it.
/// </remarks>
/// <param name="counters">Where they are counted.</param>
/// <param name="handler">Handles the rest.</param>
/// <param name="isProtected">Whether the session is.</param>
internal sealed class DatagramIntake(SessionCounters counters, IDatagramHandler handler, bool isProtected)
{
    private readonly UpdateDatagram received = new();
    private readonly byte[] opened = new byte[WireFormat.MaxPlainBytes];

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
        else if (type == DatagramType.Sealed)
        {
            Open(datagram, from);
        }
        else if (isProtected && MustBeSealed(type))
        {
            counters.DatagramsForged++;
        }
        else
        {
            Pass(type, datagram, from, isSealed: false);
        }
    }

    /// <summary>Whether datagrams of a type are sent over a link and nowhere else.</summary>
    private static bool MustBeSealed(DatagramType type) => type is DatagramType.Update or DatagramType.Leave
        or DatagramType.SnapshotRequest or DatagramType.SnapshotChunk or DatagramType.DesyncQuery or DatagramType.DesyncReport
        or DatagramType.Seat or DatagramType.Move or DatagramType.MoveChallenge
        or DatagramType.Roster or DatagramType.RosterReceived or DatagramType.KeyExchange or DatagramType.KeyExchangeReply;

    private void Open(ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (!SealedDatagram.TryDecode(datagram, out SealedDatagram sealedDatagram, out _))
        {
            counters.DatagramsMalformed++;
        }
        else if (!isProtected)
        {
            counters.DatagramsIgnored++;
        }
        else if (handler.SealOf(sealedDatagram.SessionId) is not LinkSeal seal)
        {
            handler.OnStrayDatagram(sealedDatagram.SessionId, from);
        }
        else if (!seal.TryOpen(sealedDatagram, opened, out int length, out bool isRepeated))
        {
            counters.DatagramsIgnored += isRepeated ? 1 : 0;
            counters.DatagramsForged += isRepeated ? 0 : 1;
        }
        else if (WireFormat.TryReadType(opened.AsSpan(0, length), out DatagramType type, out _)
            && (MustBeSealed(type) || type == DatagramType.Refusal))
        {
            Pass(type, opened.AsSpan(0, length), from, isSealed: true);
        }
        else
        {
            counters.DatagramsMalformed++;
        }
    }

    private void Pass(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from, bool isSealed)
    {
        if (type != DatagramType.Update)
        {
            handler.OnDatagram(type, datagram, from, isSealed);
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
