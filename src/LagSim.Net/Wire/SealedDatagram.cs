using System;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>
/// Another datagram of a protected link, encrypted: its type and everything after its session id. The session id stays readable, and a
/// number counts what its sender sealed.
/// </summary>
/// <remarks>Its bytes are those of the datagram it was read from; valid as long as those are.</remarks>
internal readonly ref struct SealedDatagram
{
    /// <summary>The highest number, 2^40 - 1: 127 days at 100,000 datagrams a second, and no session lasts longer than 23.</summary>
    internal const ulong MaxNumber = (1UL << (8 * NumberBytes)) - 1;

    /// <summary>The length of the bytes before the encrypted ones.</summary>
    internal const int PrologueBytes = InnerPrologueBytes + NumberBytes + GenerationBytes;

    /// <summary>The length of header and session id, which a sealed datagram has of its own.</summary>
    internal const int InnerPrologueBytes = WireFormat.HeaderBytes + sizeof(ulong);

    private const int NumberBytes = 5;
    private const int GenerationBytes = 1;
    private const int TypeBytes = 1;

    private SealedDatagram(ulong sessionId, ulong number, byte generation, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> body)
    {
        Prologue = prologue;
        SessionId = sessionId;
        Number = number;
        Generation = generation;
        Body = body;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>The number, from 1 to <see cref="MaxNumber"/>.</summary>
    public ulong Number { get; }

    /// <summary>Which of the link's keys seal it: the low 8 bits of <see cref="KeyExchangeDatagram.Generation"/>.</summary>
    public byte Generation { get; }

    /// <summary>The bytes before the encrypted ones, which are authenticated with them: header, session id, number and generation.</summary>
    public ReadOnlySpan<byte> Prologue { get; }

    /// <summary>The encrypted bytes and the tag.</summary>
    public ReadOnlySpan<byte> Body { get; }

    /// <summary>Seals a datagram.</summary>
    /// <param name="datagram">A datagram with a session id; up to <see cref="WireFormat.MaxPlainBytes"/>.</param>
    /// <param name="number">Its number.</param>
    /// <param name="cipher">The cipher of the link.</param>
    /// <param name="destination">Receives <see cref="WireFormat.SealBytes"/> more bytes than the datagram has.</param>
    /// <param name="generation">Which of the link's keys the cipher has.</param>
    /// <returns>The length.</returns>
    internal static int Encode(
        ReadOnlySpan<byte> datagram, ulong number, IDatagramCipher cipher, Span<byte> destination, byte generation = 0)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Sealed);
        writer.WriteBytes(datagram.Slice(WireFormat.HeaderBytes, sizeof(ulong)));
        writer.WriteUInt32((uint)number);
        writer.WriteByte((byte)(number >> 32));
        writer.WriteByte(generation);
        Span<byte> plain = stackalloc byte[WireFormat.MaxPlainBytes];
        plain = plain.Slice(0, datagram.Length - InnerPrologueBytes + TypeBytes);
        datagram.Slice(WireFormat.HeaderBytes - TypeBytes, TypeBytes).CopyTo(plain);
        datagram.Slice(InnerPrologueBytes).CopyTo(plain.Slice(TypeBytes));
        cipher.Seal(
            number, destination.Slice(0, PrologueBytes), plain, destination.Slice(PrologueBytes, plain.Length + IDatagramCipher.TagBytes));
        return PrologueBytes + plain.Length + IDatagramCipher.TagBytes;
    }

    /// <summary>Decrypts the datagram that this seals.</summary>
    /// <param name="cipher">The cipher of the link.</param>
    /// <param name="destination">Receives the datagram, with header and session id.</param>
    /// <param name="length">Its length.</param>
    /// <returns>False if the other end of the link did not seal this.</returns>
    internal bool TryOpen(IDatagramCipher cipher, Span<byte> destination, out int length)
    {
        int plain = Body.Length - IDatagramCipher.TagBytes;
        length = InnerPrologueBytes - TypeBytes + plain;

        // The type is decrypted to the last byte of the session id's place, and then moved to its own.
        Span<byte> opened = destination.Slice(InnerPrologueBytes - TypeBytes, plain);
        if (!cipher.TryOpen(Number, Prologue, Body, opened))
        {
            return false;
        }

        byte type = WireReader.ByteAt(opened, 0);
        WireWriter writer = new(destination);
        writer.WriteHeader((DatagramType)type);
        writer.WriteUInt64(SessionId);
        return true;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="sealedDatagram">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out SealedDatagram sealedDatagram, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Sealed);
        ulong sessionId = reader.ReadUInt64();
        ulong number = reader.ReadUInt32() | ((ulong)reader.ReadByte() << 32);
        byte generation = reader.ReadByte();
        reader.Require(number > 0);
        reader.Require(reader.Remaining >= TypeBytes + IDatagramCipher.TagBytes, WireRefusal.TooShort);
        ReadOnlySpan<byte> body = reader.ReadBytes(reader.Remaining);
        bool isOne = reader.Finish(out refusal);
        sealedDatagram = isOne ? new SealedDatagram(sessionId, number, generation, datagram.Slice(0, PrologueBytes), body) : default;
        return isOne;
    }
}
