using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Sends joining clients the snapshot chunks that they request, at a rate for each machine.</summary>
internal sealed class SnapshotServer(
    ClientRoster roster, MachineRates rates, AddressChallenge challenge, DatagramSender sender, SessionCounters counters,
    IClock clock)
{
    /// <summary>How often every chunk of a snapshot may be requested on average before no more are sent.</summary>
    private const int MaxRepeats = 8;

    internal void OnSnapshotRequest(in SnapshotRequestDatagram request, PeerAddress from)
    {
        Client? client = roster.Of(request.SessionId);
        if (client is null || client.Link.Other != from || client.Snapshot is null || request.Number <= client.LastRequest)
        {
            counters.DatagramsIgnored++;
            if (client is not null && client.Link.Other != from)
            {
                // Chunks are many times as long as a request, so the sender must prove its address first.
                challenge.Send(client.Link, from);
            }

            return;
        }

        SimTime now = clock.Now;
        client.LastRequest = request.Number;
        client.Link.NoteHeard(now);
        client.Link.CountReceived(WireFormat.SnapshotRequestBytes);
        SendChunks(client, client.Snapshot.Bytes, request, now);
    }

    /// <summary>Sends the requested chunks, as far as the rate allows; the client requests missing ones again.</summary>
    private void SendChunks(Client client, ReadOnlySpan<byte> snapshot, in SnapshotRequestDatagram request, SimTime now)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxPlainBytes];
        long most = MaxRepeats * ((snapshot.Length / SnapshotChunkDatagram.MaxData) + SnapshotRequestDatagram.MaxChunks);
        for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
        {
            long index = (long)request.First + n;
            if ((request.Wanted >> n & 1) == 0 || index * SnapshotChunkDatagram.MaxData >= snapshot.Length)
            {
                continue;
            }

            if (client.ChunksGiven >= most || !rates.TrySpend(client.Link.Other, now))
            {
                return;
            }

            client.ChunksGiven++;
            int at = (int)index * SnapshotChunkDatagram.MaxData;
            SnapshotChunkDatagram chunk = new(
                request.SessionId, (uint)index, snapshot.Slice(at, Math.Min(SnapshotChunkDatagram.MaxData, snapshot.Length - at)));
            sender.Send(bytes.Slice(0, chunk.Encode(bytes)), client.Link);
        }
    }
}
