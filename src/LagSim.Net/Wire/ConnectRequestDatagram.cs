using System;

namespace LagSim.Net.Wire;

/// <summary>
/// A client's first datagram to a host. The host keeps no state for it, and answers with a <see cref="ChallengeDatagram"/> of the same
/// length.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. The nonce is at the same place in every version, so that a client of another version can be answered.
/// </remarks>
internal readonly struct ConnectRequestDatagram
{
    private const int PaddingBytes = WireFormat.ConnectRequestBytes - WireFormat.HeaderBytes - sizeof(ulong) - Token128.Bytes;

    /// <summary>Creates a request from its fields.</summary>
    public ConnectRequestDatagram(ulong nonce, Token128 wanted = default)
    {
        Nonce = nonce;
        Wanted = wanted;
    }

    /// <summary>
    /// A random number from the client. Every answer carries it, so that an answer to another attempt is not taken for this one's.
    /// </summary>
    public ulong Nonce { get; }

    /// <summary>The fingerprint of the host that the client wants, so that one that has changed its key can show the former; 0 for any.</summary>
    public Token128 Wanted { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.ConnectRequestBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.ConnectRequest);
        writer.WriteUInt64(Nonce);
        Wanted.Write(ref writer);
        writer.WriteBytes(stackalloc byte[PaddingBytes]); // so that the answer is no longer than the request
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="request">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out ConnectRequestDatagram request, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.ConnectRequest);
        request = new ConnectRequestDatagram(reader.ReadUInt64(), Token128.Read(ref reader));
        ulong padding = 0;
        for (int n = 0; n < PaddingBytes; n += sizeof(ulong))
        {
            padding |= reader.ReadUInt64();
        }

        reader.Require(padding == 0);
        return reader.Finish(out refusal);
    }

    /// <summary>Reads the nonce of a connect request of any version; false if the datagram cannot be one.</summary>
    internal static bool TryReadAnyVersion(ReadOnlySpan<byte> datagram, out ulong nonce)
    {
        nonce = 0;
        if (datagram.Length < WireFormat.ShortestConnectRequestBytes
            || WireReader.ByteAt(datagram, WireFormat.HeaderBytes - 1) != (byte)DatagramType.ConnectRequest)
        {
            return false;
        }

        WireReader reader = new(datagram.Slice(WireFormat.HeaderBytes, sizeof(ulong)));
        nonce = reader.ReadUInt64();
        return true;
    }
}
