using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Makes a sender prove that it is at the address its datagrams give, before the host keeps any state for it or sends it more than it sent.
/// </summary>
internal sealed class AddressChallenge(JoinCookies cookies, DatagramSender sender, IClock clock)
{
    /// <summary>Sends a cookie, which only a peer at that address receives.</summary>
    internal void Send(ulong nonce, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.ChallengeBytes];
        sender.Send(bytes.Slice(0, new ChallengeDatagram(nonce, cookies.Make(to, nonce, clock.Now)).Encode(bytes)), to);
    }

    /// <summary>Whether the cookie was sent to that address recently.</summary>
    internal bool IsMet(PeerAddress from, ulong nonce, Token128 cookie) => cookies.IsGood(from, nonce, cookie, clock.Now);
}
