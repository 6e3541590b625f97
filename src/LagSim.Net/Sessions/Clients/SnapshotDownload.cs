using System;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's fetching of the copy of scene and world: which pieces are there, which to ask for, and when again.</summary>
/// <remarks>
/// What arrives is appended in order, and a window of pieces that came too early is kept: memory follows what was received. How many are asked for at a time is
/// the client's to say, since it sees how they come: twice as many each round trip while all come and no queue shows, and half as many when some do not come in
/// time.
/// </remarks>
internal sealed class SnapshotDownload
{
    /// <summary>So many pieces are asked for at first.</summary>
    private const uint FirstWindow = 4;

    /// <summary>The least time after which pieces that did not come are asked for again.</summary>
    private static readonly SimDuration LeastTimeout = SimDuration.FromMilliseconds(50);

    private readonly byte[]?[] early = new byte[SnapshotRequestDatagram.MaxChunks][];
    private readonly int length;
    private readonly uint count;
    private byte[] bytes = Array.Empty<byte>();
    private int have;
    private uint next;
    private uint requests;
    private uint asked; // up to which piece something was asked for
    private uint window = FirstWindow; // how many pieces may be on their way
    private bool hasQueue; // as of the last request
    private bool isToGoOn; // the window has moved on: more is to be asked for
    private SimDuration timeout; // how long the next piece may take
    private SimTime cut; // when the window was last made smaller
    private SimTime due;

    internal SnapshotDownload(int length, SimTime now)
    {
        this.length = length;
        count = (uint)((length + SnapshotChunkDatagram.MaxData - 1) / SnapshotChunkDatagram.MaxData);
        due = now;
    }

    internal bool IsComplete => next == count;

    /// <summary>The whole copy, once it is complete.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, have);

    /// <summary>When the next request is due.</summary>
    internal SimTime Due => IsComplete ? SimTime.MaxValue : due;

    /// <summary>Takes a piece in; false if it is none that is missing.</summary>
    internal bool Take(in SnapshotChunkDatagram chunk, SimTime now)
    {
        uint ahead = chunk.Index - next; // wraps for what is there already
        bool fits = chunk.Index < count && chunk.Data.Length == LengthOf(chunk.Index);
        if (!fits || ahead >= SnapshotRequestDatagram.MaxChunks || early[chunk.Index % SnapshotRequestDatagram.MaxChunks] is not null)
        {
            return false;
        }

        window = hasQueue ? window : Math.Min(window + 1, SnapshotRequestDatagram.MaxChunks);
        if (ahead > 0)
        {
            early[chunk.Index % SnapshotRequestDatagram.MaxChunks] = chunk.Data.ToArray();
        }
        else
        {
            Append(chunk.Data);
            while (next < count && early[next % SnapshotRequestDatagram.MaxChunks] is byte[] waiting)
            {
                early[next % SnapshotRequestDatagram.MaxChunks] = null;
                Append(waiting);
            }
        }

        isToGoOn = next == asked || asked - next <= window / 2; // before it is empty
        due = isToGoOn ? now : SimTime.Max(due, now + timeout);

        return true;
    }

    /// <summary>The request that is due; what does not come in answer in time is asked for again.</summary>
    /// <param name="sessionId">Of the link.</param>
    /// <param name="peer">This peer's number.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="trips">What is known of the link's round trips.</param>
    /// <param name="guessed">How long one is taken to be before one is measured.</param>
    internal SnapshotRequestDatagram Ask(ulong sessionId, byte peer, SimTime now, RoundTrips trips, SimDuration guessed)
    {
        SimDuration trip = trips.IsMeasured ? (trips.Timeout > trips.Newest ? trips.Timeout : trips.Newest) : guessed + (guessed / 2);
        timeout = trip > LeastTimeout ? trip : LeastTimeout;
        bool again = asked > next && !isToGoOn;
        isToGoOn = false;
        hasQueue = trips.HasQueue;
        if ((again || hasQueue) && now - cut > timeout)
        {
            window = Math.Max(1, window / 2);
            cut = now;
        }

        ulong wanted = 0;
        uint end = Math.Min(count, next + Math.Min(window, SnapshotRequestDatagram.MaxChunks));
        end = again ? end : Math.Max(end, asked);
        for (uint piece = again ? next : Math.Max(asked, next); piece < end; piece++)
        {
            wanted |= early[piece % SnapshotRequestDatagram.MaxChunks] is null ? 1UL << (int)(piece - next) : 0;
        }

        asked = Math.Max(asked, end);
        due = now + timeout + (timeout / 2);
        return new SnapshotRequestDatagram(sessionId, peer, ++requests, next, wanted);
    }

    private int LengthOf(uint index) => index == count - 1 ? length - ((int)index * SnapshotChunkDatagram.MaxData) : SnapshotChunkDatagram.MaxData;

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
