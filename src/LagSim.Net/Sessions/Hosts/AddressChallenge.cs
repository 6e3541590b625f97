using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Makes a sender prove that it is at the address its datagrams give, before the host keeps any state for it or sends it more than it sent.
/// </summary>
internal sealed class AddressChallenge(IHostProtection? protection, JoinCookies cookies, DatagramSender sender, IClock clock)
{
    /// <summary>Sends a cookie, which only a peer at that address receives, to one that wants to join.</summary>
    /// <param name="nonce">The nonce of the request.</param>
    /// <param name="wanted">The fingerprint of the host that it wants.</param>
    /// <param name="to">Where it came from.</param>
    internal void Send(ulong nonce, Token128 wanted, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.ChallengeBytes];
        PublicIdentity shown = PublicIdentity.Of(protection, wanted, out int key);
        ChallengeDatagram challenge = new(nonce, cookies.Make(to, nonce, clock.Now, key), shown);
        sender.Send(bytes.Slice(0, challenge.Encode(bytes)), to);
    }

    /// <summary>Sends a cookie to a client that wrote from another address than its own.</summary>
    internal void Send(UpdateLink link, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MoveChallengeBytes];
        MoveChallengeDatagram challenge = new(link.SessionId, cookies.Make(to, link.SessionId, clock.Now));
        sender.Send(bytes.Slice(0, challenge.Encode(bytes)), link, to);
    }

    /// <summary>Whether the cookie was sent to that address recently.</summary>
    internal bool IsMet(PeerAddress from, ulong nonce, Token128 cookie) => cookies.IsGood(from, nonce, cookie, clock.Now);
}
