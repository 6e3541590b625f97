using System;

namespace LagSim.Net.Wire;

/// <summary>
/// The host's answer to a <see cref="ConnectRequestDatagram"/>: the client must return this cookie to prove its address. It shows the
/// host's identity, too, which nothing proves yet.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct ChallengeDatagram
{
    /// <summary>Creates an answer from its fields.</summary>
    public ChallengeDatagram(ulong nonce, Token128 cookie, in PublicIdentity identity = default)
    {
        Nonce = nonce;
        Cookie = cookie;
        Identity = identity;
    }

    /// <summary>The <see cref="ConnectRequestDatagram.Nonce"/> that this answers.</summary>
    public ulong Nonce { get; }

    /// <summary>A token that only the host can make, and only for this address and nonce.</summary>
    public Token128 Cookie { get; }

    /// <summary>The host's identity; none if it has no protection.</summary>
    public PublicIdentity Identity { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.ChallengeBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Challenge);
        writer.WriteUInt64(Nonce);
        Cookie.Write(ref writer);
        Identity.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="challenge">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out ChallengeDatagram challenge, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Challenge);
        challenge = new ChallengeDatagram(reader.ReadUInt64(), Token128.Read(ref reader), PublicIdentity.Read(ref reader));
        return reader.Finish(out refusal);
    }
}
