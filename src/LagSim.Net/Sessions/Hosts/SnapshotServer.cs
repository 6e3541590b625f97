using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Sends those who come in the pieces of their copies that they ask for, at a pace for each machine.</summary>
internal sealed class SnapshotServer(
    ClientRoster roster, CopyPaces paces, AddressChallenge challenge, DatagramSender sender, SessionCounters counters,
    IClock clock)
{
    /// <summary>How often every piece of a copy can be asked for in the mean, before no more of it is given.</summary>
    private const int MostRepeats = 8;

    internal void OnSnapshotRequest(in SnapshotRequestDatagram request, PeerAddress from)
    {
        Client? client = roster.Of(request.SessionId);
        if (client is null || client.Link.Other != from || client.Copy is null || request.Number <= client.Fetches)
        {
            counters.DatagramsIgnored++;
            if (client is not null && client.Link.Other != from)
            {
                // Pieces are many times as long as what asks for them: it must show first that it is there.
                challenge.Send(request.SessionId, from);
            }

            return;
        }

        SimTime now = clock.Now;
        client.Fetches = request.Number;
        client.Link.NoteHeard(now);
        client.Link.CountReceived(WireFormat.SnapshotRequestBytes);
        SendPieces(client, client.Copy.Bytes, request, now);
    }

    /// <summary>Sends what is asked for, as far as the pace lets; what is still missing is asked for again.</summary>
    private void SendPieces(Client client, ReadOnlySpan<byte> copy, in SnapshotRequestDatagram request, SimTime now)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        long most = MostRepeats * ((copy.Length / SnapshotChunkDatagram.MaxData) + SnapshotRequestDatagram.MaxChunks);
        for (int n = 0; n < SnapshotRequestDatagram.MaxChunks; n++)
        {
            long index = (long)request.First + n;
            if ((request.Wanted >> n & 1) == 0 || index * SnapshotChunkDatagram.MaxData >= copy.Length)
            {
                continue;
            }

            if (client.PiecesGiven >= most || !paces.TrySpend(client.Link.Other, now))
            {
                return;
            }

            client.PiecesGiven++;
            int at = (int)index * SnapshotChunkDatagram.MaxData;
            SnapshotChunkDatagram chunk = new(request.SessionId, (uint)index, copy.Slice(at, Math.Min(SnapshotChunkDatagram.MaxData, copy.Length - at)));
            sender.Send(bytes.Slice(0, chunk.Encode(bytes)), client.Link);
        }
    }
}
