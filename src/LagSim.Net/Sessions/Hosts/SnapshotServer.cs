using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Sends those who come in the pieces of their copies that they ask for, at a pace for each machine.</summary>
internal sealed class SnapshotServer(
    JoinerRoster roster, CopyPaces paces, AddressChallenge challenge, DatagramSender sender, SessionCounters counters,
    IClock clock)
{
    /// <summary>How often every piece of a copy can be asked for in the mean, before no more of it is given.</summary>
    private const int MostRepeats = 8;

    internal void OnFetch(in FetchDatagram fetch, PeerAddress from)
    {
        Joiner? joiner = roster.Of(fetch.SessionId);
        if (joiner is null || joiner.Link.Other != from || joiner.Copy is null || fetch.Number <= joiner.Fetches)
        {
            counters.DatagramsIgnored++;
            if (joiner is not null && joiner.Link.Other != from)
            {
                // Pieces are many times as long as what asks for them: it must show first that it is there.
                challenge.Send(fetch.SessionId, from);
            }

            return;
        }

        SimTime now = clock.Now;
        joiner.Fetches = fetch.Number;
        joiner.Link.NoteHeard(now);
        joiner.Link.CountReceived(WireFormat.FetchBytes);
        SendPieces(joiner, joiner.Copy.Bytes, fetch, now);
    }

    /// <summary>Sends what is asked for, as far as the pace lets; what is still missing is asked for again.</summary>
    private void SendPieces(Joiner joiner, ReadOnlySpan<byte> copy, in FetchDatagram fetch, SimTime now)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxBytes];
        long most = MostRepeats * ((copy.Length / ChunkDatagram.MaxData) + FetchDatagram.MaxChunks);
        for (int n = 0; n < FetchDatagram.MaxChunks; n++)
        {
            long index = (long)fetch.First + n;
            if ((fetch.Wanted >> n & 1) == 0 || index * ChunkDatagram.MaxData >= copy.Length)
            {
                continue;
            }

            if (joiner.PiecesGiven >= most || !paces.TrySpend(joiner.Link.Other, now))
            {
                return;
            }

            joiner.PiecesGiven++;
            int at = (int)index * ChunkDatagram.MaxData;
            ChunkDatagram chunk = new(fetch.SessionId, (uint)index, copy.Slice(at, Math.Min(ChunkDatagram.MaxData, copy.Length - at)));
            sender.Send(bytes.Slice(0, chunk.Encode(bytes)), joiner.Link);
        }
    }
}
