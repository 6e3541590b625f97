using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>
/// A query from a client whose committed state differs from the host's, for the host's accepted events between the last time they agreed
/// and then.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct DesyncQueryDatagram
{
    /// <summary>The most events sent in answer to one query.</summary>
    public const int MaxEvents = 64;

    /// <summary>Creates a query from its fields.</summary>
    public DesyncQueryDatagram(ulong sessionId, byte peer, uint number, SimTime after, SimTime upTo, uint first)
    {
        SessionId = sessionId;
        Peer = peer;
        Number = number;
        After = after;
        UpTo = upTo;
        First = first;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The client.</summary>
    public byte Peer { get; }

    /// <summary>Counts the client's queries; one that was overtaken is not answered.</summary>
    public uint Number { get; }

    /// <summary>The shared time after which the requested events are stamped.</summary>
    public SimTime After { get; }

    /// <summary>The shared time up to which, inclusive, they are stamped; later than <see cref="After"/>.</summary>
    public SimTime UpTo { get; }

    /// <summary>The first event wanted, counted from 0 in the order of their stamps.</summary>
    public uint First { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.DesyncQueryBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that, or a time is out of range.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.DesyncQuery);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteUInt32(Number);
        writer.WriteTime(After);
        writer.WriteTime(UpTo);
        writer.WriteUInt32(First);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="query">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out DesyncQueryDatagram query, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.DesyncQuery);
        query = new DesyncQueryDatagram(
            reader.ReadUInt64(), reader.ReadByte(), reader.ReadUInt32(), reader.ReadTime(), reader.ReadTime(), reader.ReadUInt32());
        reader.Require(query.After < query.UpTo);
        return reader.Finish(out refusal);
    }
}
