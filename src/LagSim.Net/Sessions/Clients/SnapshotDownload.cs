using System;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's download of the scene and world: which chunks have arrived, which to request, and when to ask again.</summary>
/// <remarks>
/// Chunks are appended in order, and a window of early ones is buffered, so memory grows only with what was received. The client chooses
/// how many chunks to request at a time, since it sees how they arrive: the window doubles each round trip while all arrive and no queue
/// shows, and halves when some do not arrive in time.
/// </remarks>
internal sealed class SnapshotDownload
{
    /// <summary>The number of chunks requested at first.</summary>
    private const uint FirstWindow = 4;

    /// <summary>The least time after which missing chunks are requested again.</summary>
    private static readonly SimDuration MinTimeout = SimDuration.FromMilliseconds(50);

    private readonly byte[]?[] early = new byte[SnapshotRequestDatagram.MaxChunks][];
    private readonly int length;
    private byte[] bytes = Array.Empty<byte>();
    private int have;
    private int start; // where chunk 0 of this length begins
    private uint next;
    private uint requests;
    private uint asked; // one past the last chunk requested so far
    private uint window = FirstWindow; // how many chunks may be in flight
    private bool hasQueue; // as of the last request
    private bool isToGoOn; // the window has moved on: request more
    private SimDuration timeout; // how long the next chunk may take
    private SimTime cut; // when the window was last reduced
    private SimTime due;

    internal SnapshotDownload(int length, SimTime now)
    {
        this.length = length;
        due = now;
    }

    /// <summary>The length of the whole snapshot, in bytes.</summary>
    internal int Length => length;

    /// <summary>How long the chunks are that it asks for.</summary>
    internal ChunkSize Size { get; } = new();

    /// <summary>How many bytes have arrived in order.</summary>
    internal int Received => have;

    internal bool IsComplete => have == length;

    /// <summary>The whole snapshot, once it is complete.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, have);

    /// <summary>When the next request is due.</summary>
    internal SimTime Due => IsComplete ? SimTime.MaxValue : due;

    private uint Count => (uint)((length - start + Size.Data - 1) / Size.Data);

    /// <summary>Takes in a chunk; false if it is not one that is missing.</summary>
    internal bool Take(in SnapshotChunkDatagram chunk, SimTime now)
    {
        long beyond = (long)chunk.Offset - have;
        if (beyond == 0 && chunk.Data.Length > Size.Data && chunk.Data.Length == Math.Min(SnapshotChunkDatagram.MaxData, length - have))
        {
            Size.Change(); // it was late, not too long
            StartOver();
        }

        long ahead = beyond / Size.Data;
        bool fits = beyond >= 0 && beyond % Size.Data == 0 && chunk.Data.Length == Math.Min(Size.Data, length - chunk.Offset);
        if (!fits || ahead >= SnapshotRequestDatagram.MaxChunks || early[(next + ahead) % SnapshotRequestDatagram.MaxChunks] is not null)
        {
            return false;
        }

        Size.NoteArrived();

        window = hasQueue ? window : Math.Min(window + 1, SnapshotRequestDatagram.MaxChunks);
        if (ahead > 0)
        {
            early[(next + ahead) % SnapshotRequestDatagram.MaxChunks] = chunk.Data.ToArray();
        }
        else
        {
            Append(chunk.Data);
            while (!IsComplete && early[next % SnapshotRequestDatagram.MaxChunks] is byte[] waiting)
            {
                early[next % SnapshotRequestDatagram.MaxChunks] = null;
                Append(waiting);
            }
        }

        isToGoOn = next == asked || asked - next <= window / 2; // before the window runs empty
        due = isToGoOn ? now : SimTime.Max(due, now + timeout);

        return true;
    }

    /// <summary>Builds the request that is due; chunks that do not arrive in time are requested again.</summary>
    /// <param name="sessionId">The session id of the link.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="heard">When the host was last heard, likewise.</param>
    /// <param name="trips">The link's measured round trips.</param>
    /// <param name="guessed">The round trip to assume before one is measured.</param>
    internal SnapshotRequestDatagram Ask(ulong sessionId, SimTime now, SimTime heard, RoundTrips trips, SimDuration guessed)
    {
        if (Size.ChangesBefore(now, heard))
        {
            StartOver();
        }

        SimDuration trip = trips.IsMeasured ? (trips.Timeout > trips.Newest ? trips.Timeout : trips.Newest) : guessed + (guessed / 2);
        timeout = trip > MinTimeout ? trip : MinTimeout;
        bool again = asked > next && !isToGoOn;
        isToGoOn = false;
        hasQueue = trips.HasQueue;
        if ((again || hasQueue) && now - cut > timeout)
        {
            window = Math.Max(1, window / 2);
            cut = now;
        }

        ulong wanted = 0;
        uint end = Math.Min(Count, next + Math.Min(window, SnapshotRequestDatagram.MaxChunks));
        end = again ? end : Math.Max(end, asked);
        for (uint piece = again ? next : Math.Max(asked, next); piece < end; piece++)
        {
            wanted |= early[piece % SnapshotRequestDatagram.MaxChunks] is null ? 1UL << (int)(piece - next) : 0;
        }

        asked = Math.Max(asked, end);
        due = now + timeout + (timeout / 2);
        return new SnapshotRequestDatagram(sessionId, Size.Shorter, ++requests, (uint)have, wanted);
    }

    /// <summary>Goes on with chunks of another length from what is there in order.</summary>
    private void StartOver()
    {
        Array.Clear(early, 0, early.Length);
        start = have;
        next = asked = 0;
        window = FirstWindow;
    }

    private void Append(ReadOnlySpan<byte> data)
    {
        if (have + data.Length > bytes.Length)
        {
            Array.Resize(ref bytes, Math.Min(length, Math.Max(have + data.Length, 2 * bytes.Length)));
        }

        data.CopyTo(bytes.AsSpan(have));
        have += data.Length;
        next++;
    }
}
