using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Finds out who a joining client is. A good token comes first. Where it is used or over, the pass counts: by it a client that lost its
/// host comes back.
/// </summary>
internal sealed class JoinIdentification(HostOptions options, PlayerPlaces places)
{
    /// <param name="join">What the client claims.</param>
    /// <param name="token">Its connect token; empty for none.</param>
    /// <param name="binding">What its handshake alone has; empty in a session without protection.</param>
    internal JoinIdentity Of(in JoinDatagram join, ReadOnlySpan<byte> token, ReadOnlySpan<byte> binding)
    {
        bool isSpectator = join.Role == (byte)PeerRole.Spectator;
        (byte keyed, string? key) = KeyOf(join, binding);
        keyed = isSpectator ? (byte)0 : keyed; // a spectator takes no player's place, not even one that was its own
        PlayerPlaces.Place? claimed = places.Claimed(join, keyed, binding);
        if (key is null || options.Protection is not { RequiresToken: true } protection)
        {
            return new JoinIdentity(key, keyed, claimed);
        }

        TokenReading reading = token.IsEmpty ? default : protection.ReadToken(token);
        if (reading.Admission is PlayerAdmission admission)
        {
            byte number = admission.Number > 0 && !isSpectator ? admission.Number : keyed;
            return new JoinIdentity(key, number, places.OfPlayer(admission.PlayerId, isSpectator), admission, IsByToken: true);
        }

        return claimed is not null || token.IsEmpty
            ? new JoinIdentity(key, keyed, claimed, claimed?.Admission)
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
    private (byte Number, string? Key) KeyOf(in JoinDatagram join, ReadOnlySpan<byte> binding)
    {
        foreach (KeyValuePair<byte, string> player in options.PlayerKeys)
        {
            if (JoinCookies.IsProof(player.Value, join, binding))
            {
                return (player.Key, player.Value);
            }
        }

        return (0, JoinCookies.IsProof(options.ConnectKey, join, binding) ? options.ConnectKey : null);
    }
}
