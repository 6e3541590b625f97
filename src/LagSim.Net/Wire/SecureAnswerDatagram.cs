using System;

namespace LagSim.Net.Wire;

/// <summary>
/// A protected host's answer to a <see cref="SecureJoinDatagram"/>: a handshake message with its terms, or with its refusal.
/// </summary>
/// <remarks>Its bytes are those of the datagram it was read from, or will be written from; valid as long as those are.</remarks>
internal readonly ref struct SecureAnswerDatagram
{
    /// <summary>The length of the bytes before the message.</summary>
    internal const int PrologueBytes = WireFormat.HeaderBytes + sizeof(ulong);

    private SecureAnswerDatagram(ulong nonce, ReadOnlySpan<byte> message)
    {
        Nonce = nonce;
        Message = message;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> that this answers.</summary>
    public ulong Nonce { get; }

    /// <summary>The handshake message.</summary>
    public ReadOnlySpan<byte> Message { get; }

    /// <summary>Writes what comes before the message, which the handshake writes.</summary>
    /// <returns>Its length, <see cref="PrologueBytes"/>.</returns>
    internal static int WritePrologue(Span<byte> destination, DatagramType type, ulong nonce)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(type);
        writer.WriteUInt64(nonce);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="type">A secure welcome or a secure refusal.</param>
    /// <param name="answer">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">Why the datagram is not accepted, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, DatagramType type, out SecureAnswerDatagram answer, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, type);
        ulong nonce = reader.ReadUInt64();
        int whole = type == DatagramType.SecureWelcome ? WireFormat.SecureWelcomeBytes : WireFormat.SecureRefusalBytes;
        answer = new SecureAnswerDatagram(nonce, reader.ReadBytes(whole - PrologueBytes));
        return reader.Finish(out refusal);
    }
}
