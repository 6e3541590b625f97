using System;

namespace LagSim.Net.Wire;

/// <summary>A joiner asks a host to be let in. Repeated, unchanged, until it is answered.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct JoinDatagram
{
    /// <summary>A request of these fields.</summary>
    public JoinDatagram(ulong connectKey, ulong nonce, ulong sceneHash)
    {
        ConnectKey = connectKey;
        Nonce = nonce;
        SceneHash = sceneHash;
    }

    /// <summary>What the players agreed on beforehand. It keeps strays out, not attackers: it travels in the clear.</summary>
    public ulong ConnectKey { get; }

    /// <summary>A number the joiner drew; the answer carries it, so that an answer to another attempt is not taken for this one's.</summary>
    public ulong Nonce { get; }

    /// <summary>The hash of the joiner's scene.</summary>
    public ulong SceneHash { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.JoinBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Join);
        writer.WriteUInt64(ConnectKey);
        writer.WriteUInt64(Nonce);
        writer.WriteUInt64(SceneHash);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="join">What it says; meaningless on refusal.</param>
    /// <param name="refusal">Why not, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out JoinDatagram join, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Join);
        join = new JoinDatagram(reader.ReadUInt64(), reader.ReadUInt64(), reader.ReadUInt64());
        return reader.Finish(out refusal);
    }
}
