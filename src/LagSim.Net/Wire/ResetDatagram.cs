using System;
using System.Security.Cryptography;

namespace LagSim.Net.Wire;

/// <summary>
/// A protected host's answer to a sealed datagram of a session that it does not have, or no longer: why, and a proof of it. The
/// host keeps nothing for it, and makes it even after a restart.
/// </summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>. The key of the proof is in the host's welcome.</remarks>
internal readonly struct ResetDatagram
{
    /// <summary>Creates an answer from its fields.</summary>
    public ResetDatagram(ulong sessionId, LeaveReason reason, Token128 proof)
    {
        SessionId = sessionId;
        Reason = reason;
        Proof = proof;
    }

    /// <summary>Computes the proof: a keyed hash of a label and the reason.</summary>
    /// <param name="key">The key of the link, which the host's welcome told the client.</param>
    /// <param name="reason">The reason.</param>
    internal static Token128 Prove(Token128 key, LeaveReason reason)
    {
        byte[] secret = new byte[Token128.Bytes];
        key.CopyTo(secret);
        using HMACSHA256 prover = new(secret);
        return new Token128(prover.ComputeHash([.. "LagSim reset proof"u8, (byte)reason]));
    }

    /// <summary>The session that the host does not have.</summary>
    public ulong SessionId { get; }

    /// <summary>The reason, as far as the host knows it.</summary>
    public LeaveReason Reason { get; }

    /// <summary>What only who has the link's key can make of the reason.</summary>
    public Token128 Proof { get; }

    private bool IsWellFormed => Reason is >= LeaveReason.Left and <= LeaveReason.KeysTooOld;

    /// <summary>Writes the datagram.</summary>
    /// <returns>Its length, <see cref="WireFormat.ResetBytes"/>.</returns>
    /// <exception cref="ArgumentException"><paramref name="destination"/> is shorter than that.</exception>
    /// <exception cref="InvalidOperationException"><see cref="Reason"/> is not a defined value.</exception>
    public int Encode(Span<byte> destination)
    {
        if (!IsWellFormed)
        {
            throw new InvalidOperationException($"{(byte)Reason} is not the number of a reason to leave.");
        }

        WireWriter writer = new(destination);
        writer.WriteHeader(DatagramType.Reset);
        writer.WriteUInt64(SessionId);
        writer.WriteByte((byte)Reason);
        Proof.Write(ref writer);
        return writer.Position;
    }

    /// <summary>Reads a datagram; never throws.</summary>
    /// <param name="datagram">The whole datagram.</param>
    /// <param name="reset">The decoded datagram; meaningless on refusal.</param>
    /// <param name="refusal">The reason of a refusal, or <see cref="WireRefusal.None"/>.</param>
    public static bool TryDecode(ReadOnlySpan<byte> datagram, out ResetDatagram reset, out WireRefusal refusal)
    {
        WireReader reader = WireReader.Open(datagram, DatagramType.Reset);
        reset = new ResetDatagram(reader.ReadUInt64(), (LeaveReason)reader.ReadByte(), Token128.Read(ref reader));
        reader.Require(reset.IsWellFormed);
        return reader.Finish(out refusal);
    }
}
