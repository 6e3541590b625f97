using System;
using System.Collections.Generic;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Finds out who a joining client is. A pass comes before a token: who lost its host comes back with it, and its token is used.</summary>
internal sealed class JoinIdentification(HostOptions options, PlayerPlaces places)
{
    internal JoinIdentity Of(in JoinDatagram join, ReadOnlySpan<byte> token)
    {
        (byte keyed, string? key) = KeyOf(join);
        PlayerPlaces.Place? claimed = places.Claimed(join, keyed);
        if (key is null || options.Protection is not { RequiresToken: true } protection)
        {
            return new JoinIdentity(key, keyed, claimed);
        }

        if (claimed is not null)
        {
            return new JoinIdentity(key, keyed, claimed, claimed.Admission);
        }

        if (token.IsEmpty)
        {
            return new JoinIdentity(key, keyed, null, Fault: RefusalReason.TokenMissing);
        }

        TokenReading reading = protection.ReadToken(token);
        return reading.Admission is PlayerAdmission admission
            ? new JoinIdentity(key, admission.Number > 0 ? admission.Number : keyed, places.OfPlayer(admission.PlayerId), admission)
            : new JoinIdentity(key, keyed, null, Fault: ReasonOf(reading.Fault), SecondsOff: (uint)reading.Off.TotalSeconds);
    }

    private static RefusalReason ReasonOf(TokenFault fault) => fault switch
    {
        TokenFault.OtherIssuer => RefusalReason.TokenOfOtherIssuer,
        TokenFault.OtherHost => RefusalReason.TokenOfOtherHost,
        TokenFault.Expired => RefusalReason.TokenExpired,
        TokenFault.NotYetValid => RefusalReason.TokenNotYetValid,
        TokenFault.Used => RefusalReason.TokenUsed,
        _ => RefusalReason.TokenDamaged,
    };

    /// <summary>The number that a key gives, 0 for the session's, and the key; null for one that this host does not have.</summary>
    private (byte Number, string? Key) KeyOf(in JoinDatagram join)
    {
        foreach (KeyValuePair<byte, string> player in options.PlayerKeys)
        {
            if (JoinCookies.IsProof(player.Value, join))
            {
                return (player.Key, player.Value);
            }
        }

        return (0, JoinCookies.IsProof(options.ConnectKey, join) ? options.ConnectKey : null);
    }
}
