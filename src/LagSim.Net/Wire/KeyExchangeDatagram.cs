using System;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>One of the two messages by which a protected link gets fresh keys: the client's, or the host's answer to it.</summary>
/// <remarks>Its bytes are those of the datagram it was read from, or will be written from; valid as long as those are.</remarks>
internal readonly ref struct KeyExchangeDatagram
{
    /// <summary>Creates a message from its fields.</summary>
    public KeyExchangeDatagram(ulong sessionId, uint generation, ReadOnlySpan<byte> message)
    {
        SessionId = sessionId;
        Generation = generation;
        Message = message;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>Which keys it makes: those of the handshake are generation 0, each exchange makes the next.</summary>
    public uint Generation { get; }

    /// <summary>The message, of <see cref="IDatagramCipher.ExchangeBytes"/> bytes.</summary>
    public ReadOnlySpan<byte> Message { get; }

    /// <summary>Writes the datagram.</summary>
    /// <param name="type">Whose it is: <see cref="DatagramType.KeyExchange"/> or <see cref="DatagramType.KeyExchangeReply"/>.</param>
    /// <param name="destination">Receives it.</param>
    /// <returns>Its length, <see cref="WireFormat.KeyExchangeBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(DatagramType type, Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(type);
        writer.WriteUInt64(SessionId);
        writer.WriteUInt32(Generation);
        writer.WriteBytes(Message);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="type">Whose it is.</param>
    /// <param name="message">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, DatagramType type, out KeyExchangeDatagram message, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, type);
        ulong sessionId = reader.ReadUInt64();
        uint generation = reader.ReadUInt32();
        reader.Require(generation > 0);
        message = new KeyExchangeDatagram(sessionId, generation, reader.ReadBytes(IDatagramCipher.ExchangeBytes));
        return reader.Finish(out refusal);
    }
}
