using System;

namespace LagSim.Net.Wire;

/// <summary>A notice that a peer is no longer in the session, from the peer itself or from the host.</summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>.</remarks>
internal readonly struct LeaveDatagram
{
    /// <summary>Creates a notice from its fields.</summary>
    public LeaveDatagram(ulong sessionId, byte peer, LeaveReason reason)
    {
        SessionId = sessionId;
        Peer = peer;
        Reason = reason;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The peer that is gone; 0 is the host.</summary>
    public byte Peer { get; }

    /// <summary>The reason.</summary>
    public LeaveReason Reason { get; }

    private bool IsWellFormed => Reason is >= LeaveReason.Left and <= LeaveReason.Kicked;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.LeaveBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Reason"/> is not a defined value.</exception>
    public int Encode(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException($"{(byte)Reason} is not the number of a reason to leave.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Leave);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        writer.WriteByte((byte)Reason);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="leave">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out LeaveDatagram leave, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Leave);
        leave = new LeaveDatagram(reader.ReadUInt64(), reader.ReadByte(), (LeaveReason)reader.ReadByte());
        reader.Require(leave.IsWellFormed);
        return reader.Finish(out refusal);
    }
}
