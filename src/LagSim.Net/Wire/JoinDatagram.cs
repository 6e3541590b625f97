using System;
using System.Text;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>A challenged client's request to be let in, repeated unchanged until it is answered.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct JoinDatagram
{
    private readonly string? name;

    /// <summary>Creates a request from its fields.</summary>
    public JoinDatagram(
        ulong nonce, Token128 cookie, Token128 proof, ulong sceneHash, uint foldVersion, byte player = 0, Token128 playerProof = default,
        byte role = 1, string? name = null)
    {
        Nonce = nonce;
        Cookie = cookie;
        Proof = proof;
        SceneHash = sceneHash;
        FoldVersion = foldVersion;
        Player = player;
        PlayerProof = playerProof;
        Role = role;
        this.name = name;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> of this attempt.</summary>
    public ulong Nonce { get; }

    /// <summary>The cookie from the host.</summary>
    public Token128 Cookie { get; }

    /// <summary>Proves that the client knows the connect key, without revealing it: a keyed hash of nonce and cookie, and of the handshake.</summary>
    public Token128 Proof { get; }

    /// <summary>The hash of the scene that the client expects; 0 for any.</summary>
    public ulong SceneHash { get; }

    /// <summary>The version of the rules by which the client computes worlds; see <see cref="Simulation.FoldVersion"/>.</summary>
    public uint FoldVersion { get; }

    /// <summary>
    /// The number of the player that the client was before; 0 for none, and then there is no <see cref="PlayerProof"/> either.
    /// </summary>
    public byte Player { get; }

    /// <summary>Proves that the client has that player's pass, without revealing it: a keyed hash of nonce and cookie, and of the handshake.</summary>
    public Token128 PlayerProof { get; }

    /// <summary>As what it takes part: 1 a player, 2 a spectator, 3 a bot.</summary>
    public byte Role { get; }

    /// <summary>What it calls itself; may be empty.</summary>
    public string Name => name ?? "";

    /// <summary>The encoded length of the claims.</summary>
    internal int ClaimBytes => WireFormat.JoinClaimBytes + Encoding.UTF8.GetByteCount(Name);

    /// <summary>The encoded length.</summary>
    public int EncodedLength => WireFormat.JoinPrologueBytes + ClaimBytes;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="EncodedLength"/>.</returns>
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
    /// <returns>Its length, <see cref="ClaimBytes"/>.</returns>
    internal int EncodeClaims(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        Proof.Write(ref writer);
        writer.WriteUInt64(SceneHash);
        writer.WriteUInt32(FoldVersion);
        writer.WriteByte(Player);
        PlayerProof.Write(ref writer);
        writer.WriteByte(Role);
        WireText.Write(ref writer, Name);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="join">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out JoinDatagram join, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Join);
        join = ReadClaims(ref reader, reader.ReadUInt64(), Token128.Read(ref reader));
        return reader.Finish(out refusal);
    }

    /// <summary>
    /// Reads what a client claims in a <see cref="SecureJoinDatagram"/> of that nonce and cookie, and how many bytes that took; never
    /// throws. What follows is a connect token.
    /// </summary>
    internal static bool TryDecodeClaims(ReadOnlySpan<byte> claims, ulong nonce, Token128 cookie, out JoinDatagram join, out int length)
    {
        WireReader reader = new(claims);
        join = ReadClaims(ref reader, nonce, cookie);
        length = claims.Length - reader.Remaining;
        return reader.Refusal == WireRefusal.None && reader.Remaining <= IHostProtection.MaxTokenBytes;
    }

    private static JoinDatagram ReadClaims(ref WireReader reader, ulong nonce, Token128 cookie)
    {
        JoinDatagram join = new(
            nonce, cookie, Token128.Read(ref reader), reader.ReadUInt64(), reader.ReadUInt32(), reader.ReadByte(),
            Token128.Read(ref reader), reader.ReadByte(), RosterEntry.ReadName(ref reader));
        reader.Require(join.Player != 0 || join.PlayerProof == default);
        reader.Require(join.Role is > RosterEntry.NoRole and <= RosterEntry.MaxRole);
        return join;
    }
}
