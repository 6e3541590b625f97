using System;

namespace LagSim.Net.Wire;

/// <summary>
/// A client's answer to a challenge at its new address, with the cookie that the host sent there; the host sends there from then on.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct MoveDatagram
{
    /// <summary>Creates a move from its fields.</summary>
    public MoveDatagram(ulong sessionId, byte peer, Token128 cookie)
    {
        SessionId = sessionId;
        Peer = peer;
        Cookie = cookie;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The client; 0 if it has no number yet.</summary>
    public byte Peer { get; }

    /// <summary>The cookie of the <see cref="MoveChallengeDatagram"/>.</summary>
    public Token128 Cookie { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.MoveBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Move);
        writer.WriteUInt64(SessionId);
        writer.WriteByte(Peer);
        Cookie.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="move">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out MoveDatagram move, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Move);
        move = new MoveDatagram(reader.ReadUInt64(), reader.ReadByte(), Token128.Read(ref reader));
        return reader.Finish(out refusal);
    }
}
