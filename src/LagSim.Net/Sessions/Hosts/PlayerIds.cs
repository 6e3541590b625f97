using System;
using System.Buffers.Binary;
using System.Security.Cryptography;
using System.Text;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Numbers that say who somebody is, for rules: the same for the same person as long as the host lasts.</summary>
/// <remarks>
/// HMAC-SHA-256, cut to 64 bits, of what the host knows a person by: what its connect token says, else the number that its own key gives, else
/// the visit, which goes on as long as its pass does. The key is the session's number, which no peer is told, so the result says nothing of
/// the token. It is not drawn: sessions that are played again by seed get the same.
/// </remarks>
/// <param name="sessionId">The session's number.</param>
internal sealed class PlayerIds(ulong sessionId)
{
    private static ReadOnlySpan<byte> Label => "LagSim player"u8;

    /// <summary>The host's own.</summary>
    internal ulong OfHost => Of("host");

    /// <summary>That of a client.</summary>
    /// <param name="who">Who it proved to be.</param>
    /// <param name="visit">What distinguishes it from all who came without a token or a key of their own.</param>
    internal ulong Of(JoinIdentity who, uint visit) => Of(
        who.Admission is not null ? $"token {who.Admission.PlayerId}"
        : FormattableString.Invariant(who.Keyed > 0 ? $"key {who.Keyed}" : (FormattableString)$"visit {visit}"));

    private ulong Of(string person)
    {
        byte[] key = new byte[sizeof(ulong)];
        BinaryPrimitives.WriteUInt64LittleEndian(key, sessionId);
        byte[] name = Encoding.UTF8.GetBytes(person);
        byte[] labelled = new byte[Label.Length + name.Length];
        Label.CopyTo(labelled);
        name.CopyTo(labelled, Label.Length);
        using HMACSHA256 maker = new(key);
        return Math.Max(1, BinaryPrimitives.ReadUInt64LittleEndian(maker.ComputeHash(labelled)));
    }
}
