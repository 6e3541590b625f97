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
    /// <summary>How often every byte of a snapshot may be requested on average before no more are sent.</summary>
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
        client.Link.Path.Bytes = request.ChunkBytes + WireFormat.EmptySnapshotChunkBytes + WireFormat.SealBytes;
        SendChunks(client, client.Snapshot.Bytes, request, now);
    }

    /// <summary>Sends the requested chunks, as far as the rate allows; the client requests missing ones again.</summary>
    private void SendChunks(Client client, ReadOnlySpan<byte> snapshot, in SnapshotRequestDatagram request, SimTime now)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxPlainBytes];
        long most = MaxRepeats * (snapshot.Length + (SnapshotRequestDatagram.MaxChunks * (long)SnapshotChunkDatagram.MaxData));
        for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
        {
            long at = request.First + ((long)n * request.ChunkBytes);
            if ((request.Wanted >> n & 1) == 0 || at >= snapshot.Length)
            {
                continue;
            }

            if (client.CopyBytesGiven >= most || !rates.TrySpend(client.Link.Other, now))
            {
                return;
            }

            SnapshotChunkDatagram chunk = new(
                request.SessionId, (uint)at, snapshot.Slice((int)at, Math.Min(request.ChunkBytes, snapshot.Length - (int)at)));
            client.CopyBytesGiven += chunk.Data.Length;
            sender.Send(bytes.Slice(0, chunk.Encode(bytes)), client.Link);
        }
    }
}
