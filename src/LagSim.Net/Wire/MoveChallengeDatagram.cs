using System;

namespace LagSim.Net.Wire;

/// <summary>
/// The host's answer to a client's datagram from a new address: the client must return this cookie to prove that address.
/// </summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct MoveChallengeDatagram
{
    /// <summary>Creates an answer from its fields.</summary>
    public MoveChallengeDatagram(ulong sessionId, Token128 cookie)
    {
        SessionId = sessionId;
        Cookie = cookie;
    }

    /// <summary>The session.</summary>
    public ulong SessionId { get; }

    /// <summary>A token that only the host can make, and only for this address and session.</summary>
    public Token128 Cookie { get; }

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.MoveChallengeBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    public int Encode(Span<byte> destination)
    {
        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.MoveChallenge);
        writer.WriteUInt64(SessionId);
        Cookie.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="challenge">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out MoveChallengeDatagram challenge, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.MoveChallenge);
        challenge = new MoveChallengeDatagram(reader.ReadUInt64(), Token128.Read(ref reader));
        return reader.Finish(out refusal);
    }
}
