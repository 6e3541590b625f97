using System;

namespace LagSim.Net.Wire;

/// <summary>A client's request for chunks of the announced snapshot.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct SnapshotRequestDatagram
{
    /// <summary>The most chunks requested at once.</summary>
    public const int MaxChunks = 64;

    /// <summary>The greatest <see cref="Shorter"/>: every path of IPv4 carries datagrams with such chunks.</summary>
    public const byte MaxShorter = (SnapshotChunkDatagram.MaxData - SnapshotChunkDatagram.LeastData) / ShorterUnit;

    private const int ShorterUnit = 4;

    /// <summary>Creates a request from its fields.</summary>
    public SnapshotRequestDatagram(ulong sessionId, byte shorter, uint number, uint first, ulong wanted)
    {
        SessionId = sessionId;
        Shorter = shorter;
        Number = number;
        First = first;
        Wanted = wanted;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>By how many times four bytes the chunks are to be shorter than the longest, up to <see cref="MaxShorter"/>.</summary>
    public byte Shorter { get; }

    /// <summary>The length of the chunks, but of the copy's last, in bytes.</summary>
    public int ChunkBytes => SnapshotChunkDatagram.MaxData - (ShorterUnit * Shorter);

    /// <summary>Counts the client's requests; one that was overtaken is not answered.</summary>
    public uint Number { get; }

    /// <summary>Where in the copy the first missing chunk begins, in bytes.</summary>
    public uint First { get; }

    /// <summary>Bit n: the chunk is wanted that begins n times <see cref="ChunkBytes"/> after <see cref="First"/>.</summary>
    public ulong Wanted { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.SnapshotRequestBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Shorter"/> is out of range.</exception>
    public int Encode(Span<byte> destination)
    {
        if (Shorter > MaxShorter)
        {
            throw new InvalidOperationException($"Chunks are shorter by 0 to {MaxShorter} times {ShorterUnit} bytes, not {Shorter}.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.SnapshotRequest);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Shorter);
        writer.WriteUInt32(Number);
        writer.WriteUInt32(First);
        writer.WriteUInt64(Wanted);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="request">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out SnapshotRequestDatagram request, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.SnapshotRequest);
        request = new SnapshotRequestDatagram(reader.ReadUInt64(), reader.ReadByte(), reader.ReadUInt32(), reader.ReadUInt32(), reader.ReadUInt64());
        reader.Require(request.Shorter <= MaxShorter);
        return reader.Finish(out refusal);
    }
}
