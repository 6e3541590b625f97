using System;

namespace LagSim.Net.Wire;

/// <summary>A chunk of the snapshot of scene and world that a client downloads.</summary>
/// <remarks>Its bytes are those of the datagram it was read from, or will be written from; valid as long as those are.</remarks>
internal readonly ref struct SnapshotChunkDatagram
{
    /// <summary>The length of the longest chunk.</summary>
    public const int MaxData = WireFormat.MaxPlainBytes - WireFormat.EmptySnapshotChunkBytes;

    /// <summary>The length of chunks whose datagrams any path carries; see <see cref="WireFormat.LeastPathBytes"/>.</summary>
    public const int LeastData = WireFormat.LeastPathBytes - WireFormat.SealBytes - WireFormat.EmptySnapshotChunkBytes;

    /// <summary>Creates a chunk from its fields.</summary>
    public SnapshotChunkDatagram(ulong sessionId, uint offset, ReadOnlySpan<byte> data)
    {
        SessionId = sessionId;
        Offset = offset;
        Data = data;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>Where in the copy it begins, in bytes.</summary>
    public uint Offset { get; }

    /// <summary>Its bytes, 1 to <see cref="MaxData"/>.</summary>
    public ReadOnlySpan<byte> Data { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is too short.</exception>
    /// <exception cref="InvalidOperationException">There are no bytes, or more than <see cref="MaxData"/>.</exception>
    public int Encode(Span<byte> destination)
    {
        if (Data.Length is 0 or > MaxData)
        {
            throw new InvalidOperationException($"A piece has 1 to {MaxData} bytes; this one has {Data.Length}.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.SnapshotChunk);
        writer.WriteUInt64(SessionId);
        writer.WriteUInt32(Offset);
        writer.WriteBytes(Data);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="chunk">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out SnapshotChunkDatagram chunk, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.SnapshotChunk);
        ulong session = reader.ReadUInt64();
        uint offset = reader.ReadUInt32();
        ReadOnlySpan<byte> data = reader.ReadBytes(reader.Remaining);
        reader.Require(data.Length > 0, WireRefusal.TooShort);
        chunk = new SnapshotChunkDatagram(session, offset, data);
        return reader.Finish(out refusal);
    }
}
