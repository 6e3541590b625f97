using System;
using System.Buffers.Binary;
using System.Security.Cryptography;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A joiner's fetching of the copy of scene and world: which pieces are there, which to ask for, and when again.</summary>
/// <remarks>What arrives is appended in order, and a window of pieces that came too early is kept: memory follows what was received.</remarks>
internal sealed class CopyFetch
{
    private readonly byte[]?[] early = new byte[FetchDatagram.MaxChunks][];
    private readonly int length;
    private readonly uint count;
    private byte[] bytes = Array.Empty<byte>();
    private int have;
    private uint next;
    private uint requests;
    private uint asked; // up to which piece something was asked for
    private SimTime due;

    internal CopyFetch(int length, SimTime now)
    {
        this.length = length;
        count = (uint)((length + ChunkDatagram.MaxData - 1) / ChunkDatagram.MaxData);
        due = now;
    }

    /// <summary>What tells a copy that arrived whole: the first eight bytes of its SHA-256.</summary>
    internal static ulong HashOf(ReadOnlySpan<byte> copy)
    {
        using SHA256 hash = SHA256.Create();
        Span<byte> bytes = stackalloc byte[32];
        return hash.TryComputeHash(copy, bytes, out _)
            ? BinaryPrimitives.ReadUInt64LittleEndian(bytes)
            : throw new InvalidOperationException("SHA-256 gave more than 32 bytes.");
    }

    internal bool IsComplete => next == count;

    /// <summary>The whole copy, once it is complete.</summary>
    internal ReadOnlySpan<byte> Bytes => bytes.AsSpan(0, have);

    /// <summary>When the next request is due.</summary>
    internal SimTime Due => IsComplete ? SimTime.MaxValue : due;

    /// <summary>Takes a piece in; false if it is none that is missing.</summary>
    internal bool Take(in ChunkDatagram chunk, SimTime now)
    {
        uint ahead = chunk.Index - next; // wraps for what is there already
        bool fits = chunk.Index < count && chunk.Data.Length == LengthOf(chunk.Index);
        if (!fits || ahead >= FetchDatagram.MaxChunks || early[chunk.Index % FetchDatagram.MaxChunks] is not null)
        {
            return false;
        }

        if (ahead > 0)
        {
            early[chunk.Index % FetchDatagram.MaxChunks] = chunk.Data.ToArray();
        }
        else
        {
            Append(chunk.Data);
            while (next < count && early[next % FetchDatagram.MaxChunks] is byte[] waiting)
            {
                early[next % FetchDatagram.MaxChunks] = null;
                Append(waiting);
            }
        }

        if (next == asked || asked - next < FetchDatagram.MaxChunks / 2)
        {
            due = now; // the window has moved on: ask for more before it is empty
        }

        return true;
    }

    /// <summary>The request that is due; what it asks for is expected within <paramref name="patience"/>, else it is asked for again.</summary>
    internal FetchDatagram Ask(ulong sessionId, byte peer, SimTime now, SimDuration patience)
    {
        bool again = asked > next && now >= due && !HasRoom();
        ulong wanted = 0;
        uint end = Math.Min(count, next + FetchDatagram.MaxChunks);
        for (uint piece = again ? next : Math.Max(asked, next); piece < end; piece++)
        {
            wanted |= early[piece % FetchDatagram.MaxChunks] is null ? 1UL << (int)(piece - next) : 0;
        }

        asked = end;
        due = now + patience;
        return new FetchDatagram(sessionId, peer, ++requests, next, wanted);
    }

    private bool HasRoom() => asked < Math.Min(count, next + FetchDatagram.MaxChunks);

    private int LengthOf(uint index) => index == count - 1 ? length - ((int)index * ChunkDatagram.MaxData) : ChunkDatagram.MaxData;

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
