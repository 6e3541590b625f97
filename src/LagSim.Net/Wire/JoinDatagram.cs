using System;

namespace LagSim.Net.Wire;

/// <summary>A challenged client's request to be let in, repeated unchanged until it is answered.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct JoinDatagram
{
    /// <summary>Creates a request from its fields.</summary>
    public JoinDatagram(ulong nonce, Token128 cookie, Token128 proof, ulong sceneHash, uint foldVersion, byte player = 0, Token128 playerProof = default)
    {
        Nonce = nonce;
        Cookie = cookie;
        Proof = proof;
        SceneHash = sceneHash;
        FoldVersion = foldVersion;
        Player = player;
        PlayerProof = playerProof;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> of this attempt.</summary>
    public ulong Nonce { get; }

    /// <summary>The cookie from the host.</summary>
    public Token128 Cookie { get; }

    /// <summary>Proves that the client knows the connect key, without revealing it: a keyed hash of nonce and cookie.</summary>
    public Token128 Proof { get; }

    /// <summary>The hash of the scene that the client expects; 0 for any.</summary>
    public ulong SceneHash { get; }

    /// <summary>The version of the rules by which the client computes worlds; see <see cref="Simulation.FoldVersion"/>.</summary>
    public uint FoldVersion { get; }

    /// <summary>
    /// The number of the player that the client was before; 0 for none, and then there is no <see cref="PlayerProof"/> either.
    /// </summary>
    public byte Player { get; }

    /// <summary>Proves that the client has that player's pass, without revealing it: a keyed hash of nonce and cookie.</summary>
    public Token128 PlayerProof { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.JoinBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        int length = WritePrologue(destination, DatagramType.Join, Nonce, Cookie);
        return length + EncodeClaims(destination.Slice(length));
    }

    /// <summary>Writes what comes before the claims, of this datagram and of a <see cref="SecureJoinDatagram"/>.</summary>
    /// <returns>Its length, <see cref="WireFormat.JoinPrologueBytes"/>.</returns>
    internal static int WritePrologue(Span<byte> destination, DatagramType type, ulong nonce, Token128 cookie)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(type);
        writer.WriteUInt64(nonce);
        cookie.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Writes what the client claims: all but nonce and cookie.</summary>
    /// <returns>Its length, <see cref="WireFormat.JoinClaimBytes"/>.</returns>
    internal int EncodeClaims(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        Proof.Write(ref writer);
        writer.WriteUInt64(SceneHash);
        writer.WriteUInt32(FoldVersion);
        writer.WriteByte(Player);
        PlayerProof.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="join">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out JoinDatagram join, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Join);
        return TryReadClaims(ref reader, reader.ReadUInt64(), Token128.Read(ref reader), out join, out refusal);
    }

    /// <summary>Reads what a client claims in a <see cref="SecureJoinDatagram"/> of that nonce and cookie; never throws.</summary>
    internal static bool TryDecodeClaims(ReadOnlySpan<byte> claims, ulong nonce, Token128 cookie, out JoinDatagram join)
    {
        WireReader reader = new(claims);
        return TryReadClaims(ref reader, nonce, cookie, out join, out _);
    }

    private static bool TryReadClaims(ref WireReader reader, ulong nonce, Token128 cookie, out JoinDatagram join, out WireRefusal refusal)
    {
        join = new JoinDatagram(
            nonce, cookie, Token128.Read(ref reader), reader.ReadUInt64(), reader.ReadUInt32(), reader.ReadByte(),
            Token128.Read(ref reader));
        reader.Require(join.Player != 0 || join.PlayerProof == default);
        return reader.Finish(out refusal);
    }
}
