using System;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The identity of a welcomed client: its join, and who it proved to be.</summary>
internal sealed class JoinClaim
{
    /// <param name="join">The join.</param>
    /// <param name="who">Who it proved to be.</param>
    /// <param name="token">The connect token that it sent; empty for none.</param>
    /// <param name="handshake">Which handshake it began; default in a session without protection.</param>
    /// <param name="until">When it is given up if it has no number by then.</param>
    internal JoinClaim(in JoinDatagram join, JoinIdentity who, ReadOnlySpan<byte> token, Token128 handshake, SimTime until)
    {
        Nonce = join.Nonce;
        Cookie = join.Cookie;
        Handshake = handshake;
        Wanted = join.Player;
        Role = join.Role;
        Name = join.Name;
        Who = who;
        ClaimedPass = who.Claimed?.Pass;
        Token = who.IsByToken ? token.ToArray() : [];
        Until = until;
    }

    internal ulong Nonce { get; }

    internal Token128 Cookie { get; }

    /// <summary>
    /// The first bytes of the handshake, which are of a key that the client drew: somebody on the path can join in its name with its nonce
    /// and cookie, but not with this. Default in a session without protection.
    /// </summary>
    internal Token128 Handshake { get; }

    /// <summary>The number that it says it had; 0 for none.</summary>
    internal byte Wanted { get; }

    /// <summary>As what it takes part, as on the wire.</summary>
    internal byte Role { get; }

    /// <summary>What it calls itself.</summary>
    internal string Name { get; }

    /// <summary>Whether it wants a spectator's number.</summary>
    internal bool IsSpectator => Role == (byte)PeerRole.Spectator;

    /// <summary>The connect token that lets it in; empty if something else does.</summary>
    internal byte[] Token { get; }

    /// <summary>The place of the player that it was before, unless another has taken it since; null for none.</summary>
    internal PlayerPlaces.Place? Former => Who.Claimed is not null && Who.Claimed.Pass == ClaimedPass ? Who.Claimed : null;

    /// <summary>Who it is by now: as it proved, unless another player has its former place.</summary>
    internal JoinIdentity Identity => Who with { Claimed = Former };

    /// <summary>When it is given up if it has no number by then.</summary>
    internal SimTime Until { get; }

    private JoinIdentity Who { get; }

    private Token128? ClaimedPass { get; }
}
