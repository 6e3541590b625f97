using System;

namespace LagSim.Net.Wire;

/// <summary>The host's refusal of a client, with the reason.</summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>. Its layout is the same in every version.</remarks>
internal readonly struct RefusalDatagram
{
    /// <summary>Creates an answer from its fields.</summary>
    public RefusalDatagram(ulong nonce, RefusalReason reason)
    {
        Nonce = nonce;
        Reason = reason;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> that this answers.</summary>
    public ulong Nonce { get; }

    /// <summary>The reason.</summary>
    public RefusalReason Reason { get; }

    private bool IsWellFormed => IsOne(Reason);

    /// <summary>Whether a number is that of a reason.</summary>
    internal static bool IsOne(RefusalReason reason) => reason is >= RefusalReason.VersionDiffers and <= RefusalReason.TooManyWrongKeys;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.RefusalBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Reason"/> is not a defined value.</exception>
    public int Encode(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException($"{(byte)Reason} is not the number of a reason for refusal.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Refusal);
        writer.WriteUInt64(Nonce);
        writer.WriteByte((byte)Reason);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="answer">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">Why the datagram is not accepted, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out RefusalDatagram answer, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Refusal);
        answer = new RefusalDatagram(reader.ReadUInt64(), (RefusalReason)reader.ReadByte());
        reader.Require(answer.IsWellFormed);
        return reader.Finish(out refusal);
    }

    /// <summary>Reads a refusal of any version, and that version; false if the datagram cannot be one.</summary>
    internal static bool TryReadAnyVersion(ReadOnlySpan<byte> datagram, out ulong nonce, out byte version)
    {
        nonce = 0;
        version = 0;
        if (datagram.Length != WireFormat.RefusalBytes || WireReader.ByteAt(datagram, WireFormat.HeaderBytes - 1) != (byte)DatagramType.Refusal)
        {
            return false;
        }

        version = WireReader.ByteAt(datagram, sizeof(ushort));
        WireReader reader = new(datagram.Slice(WireFormat.HeaderBytes, sizeof(ulong)));
        nonce = reader.ReadUInt64();
        return true;
    }
}
