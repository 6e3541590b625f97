using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Has somebody show that it is at the address that its datagrams give, before anything is kept of it or sent to it that is longer than
/// what it sent.
/// </summary>
internal sealed class AddressChallenge(JoinCookies cookies, DatagramSender sender, IClock clock)
{
    /// <summary>Sends a cookie, which only who is at that address gets.</summary>
    internal void Send(ulong nonce, PeerAddress to)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.ChallengeBytes];
        sender.Send(bytes.Slice(0, new ChallengeDatagram(nonce, cookies.Make(to, nonce, clock.Now)).Encode(bytes)), to);
    }

    /// <summary>Whether a cookie was sent to that address lately.</summary>
    internal bool IsMet(PeerAddress from, ulong nonce, Token128 cookie) => cookies.IsGood(from, nonce, cookie, clock.Now);
}
