using System;
using LagSim.Net.Protection;

namespace LagSim.Net.Wire;

/// <summary>
/// A challenged client's request to be let in by a protected host: a handshake message whose payload is what a <see cref="JoinDatagram"/>
/// claims, and a connect token. Repeated unchanged until it is answered.
/// </summary>
/// <remarks>Its bytes are those of the datagram it was read from; valid as long as those are.</remarks>
internal readonly ref struct SecureJoinDatagram
{
    /// <summary>The length of a message without a name and a connect token.</summary>
    private const int LeastMessageBytes = IHostProtection.HandshakeOverhead + WireFormat.JoinClaimBytes;

    private SecureJoinDatagram(ulong nonce, Token128 cookie, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message)
    {
        Nonce = nonce;
        Cookie = cookie;
        Prologue = prologue;
        Message = message;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> of this attempt.</summary>
    public ulong Nonce { get; }

    /// <summary>The cookie from the host.</summary>
    public Token128 Cookie { get; }

    /// <summary>The bytes before the message, which the handshake covers.</summary>
    public ReadOnlySpan<byte> Prologue { get; }

    /// <summary>The handshake message.</summary>
    public ReadOnlySpan<byte> Message { get; }

    /// <summary>The first bytes of the message: of the public key that the client drew for this handshake.</summary>
    internal Token128 Handshake => new(Message.Slice(0, Token128.Bytes));

    /// <summary>Begins the handshake that the datagram carries.</summary>
    /// <param name="nonce">The nonce of this attempt.</param>
    /// <param name="cookie">The cookie from the host.</param>
    /// <param name="identity">The identity that the host shows.</param>
    /// <param name="protection">The client's side of the handshake.</param>
    /// <returns>The handshake; null if the client does not want the host with that identity.</returns>
    internal static IClientHandshake? Begin(ulong nonce, Token128 cookie, in PublicIdentity identity, IClientProtection protection)
    {
        Span<byte> prologue = stackalloc byte[WireFormat.JoinPrologueBytes];
        JoinDatagram.WritePrologue(prologue, DatagramType.SecureJoin, nonce, cookie);
        Span<byte> shown = stackalloc byte[IHostProtection.IdentityBytes];
        WireWriter writer = new(shown);
        identity.Write(ref writer);
        return protection.Begin(shown, prologue);
    }

    /// <summary>Writes the datagram, whose message the handshake writes.</summary>
    /// <param name="destination">
    /// At least <see cref="WireFormat.SecureJoinBytes"/>, and as many more as name and token have.
    /// </param>
    /// <param name="join">What the client claims.</param>
    /// <param name="token">Its connect token; empty for none.</param>
    /// <param name="handshake">The handshake that was begun for this nonce and cookie.</param>
    internal static void Encode(Span<byte> destination, in JoinDatagram join, ReadOnlySpan<byte> token, IClientHandshake handshake)
    {
        int length = JoinDatagram.WritePrologue(destination, DatagramType.SecureJoin, join.Nonce, join.Cookie);
        Span<byte> claims = stackalloc byte[join.ClaimBytes + token.Length];
        token.CopyTo(claims.Slice(join.EncodeClaims(claims)));
        handshake.Write(claims, destination.Slice(length, IHostProtection.HandshakeOverhead + claims.Length));
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="join">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out SecureJoinDatagram join, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.SecureJoin);
        ulong nonce = reader.ReadUInt64();
        Token128 cookie = Token128.Read(ref reader);
        int length = reader.Remaining;
        reader.Require(length >= LeastMessageBytes, WireRefusal.TooShort);
        reader.Require(length <= LeastMessageBytes + RosterEntry.MaxNameBytes + IHostProtection.MaxTokenBytes, WireRefusal.TrailingBytes);
        ReadOnlySpan<byte> message = reader.ReadBytes(length);
        bool isOne = reader.Finish(out refusal);
        join = isOne ? new SecureJoinDatagram(nonce, cookie, datagram.Slice(0, WireFormat.JoinPrologueBytes), message) : default;
        return isOne;
    }
}
