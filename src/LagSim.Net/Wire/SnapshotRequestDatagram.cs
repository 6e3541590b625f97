using System;

namespace LagSim.Net.Wire;

/// <summary>A client's request for chunks of the announced snapshot.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct SnapshotRequestDatagram
{
    /// <summary>The most chunks requested at once.</summary>
    public const int MaxChunks = 64;

    /// <summary>Creates a request from its fields.</summary>
    public SnapshotRequestDatagram(ulong sessionId, byte peer, uint number, uint first, ulong wanted)
    {
        SessionId = sessionId;
        Peer = peer;
        Number = number;
        First = first;
        Wanted = wanted;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The client.</summary>
    public byte Peer { get; }

    /// <summary>Counts the client's requests; one that was overtaken is not answered.</summary>
    public uint Number { get; }

    /// <summary>The first chunk that is missing, counted from 0.</summary>
    public uint First { get; }

    /// <summary>Bit n: chunk <see cref="First"/> + n is wanted.</summary>
    public ulong Wanted { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.SnapshotRequestBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.SnapshotRequest);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
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
        return reader.Finish(out refusal);
    }
}
