using System;

namespace LagSim.Net.Wire;

/// <summary>A client's acknowledgement of a <see cref="RosterDatagram"/>.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct RosterReceivedDatagram
{
    /// <summary>Creates an acknowledgement from its fields.</summary>
    public RosterReceivedDatagram(ulong sessionId, byte peer, uint revision)
    {
        SessionId = sessionId;
        Peer = peer;
        Revision = revision;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The client; 0 if it does not know its number yet.</summary>
    public byte Peer { get; }

    /// <summary>The revision that it has.</summary>
    public uint Revision { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.RosterReceivedBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.RosterReceived);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteUInt32(Revision);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="received">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out RosterReceivedDatagram received, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.RosterReceived);
        received = new RosterReceivedDatagram(reader.ReadUInt64(), reader.ReadByte(), reader.ReadUInt32());
        return reader.Finish(out refusal);
    }
}
