using System;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Tells a sender that it missed the goodbye or never was a client of this host, with the session id of its own datagram, in fewer bytes
/// than it sent.
/// </summary>
/// <param name="places">Why clients are gone.</param>
/// <param name="status">Whether the session has ended.</param>
/// <param name="protection">Proves the host to the sender; null in a session without protection.</param>
/// <param name="sender">Sends the reply.</param>
internal sealed class StrayReply(PlayerPlaces places, SessionStatus status, IHostProtection? protection, DatagramSender sender)
{
    internal void Send(PeerAddress to, ulong sessionId)
    {
        LeaveReason reason = status.HasEnded ? LeaveReason.HostEnded : places.WhyGone(sessionId);
        Span<byte> bytes = stackalloc byte[WireFormat.ResetBytes];
        if (protection is null)
        {
            sender.Send(bytes.Slice(0, new LeaveDatagram(sessionId, 0, reason).Encode(bytes)), to);
            return;
        }

        sender.Send(bytes.Slice(0, new ResetDatagram(sessionId, reason, Token(protection, sessionId)).Encode(bytes)), to);
    }

    /// <summary>What proves to the client with that session id that the host does not have it any more.</summary>
    internal static Token128 Token(IHostProtection protection, ulong sessionId)
    {
        Span<byte> token = stackalloc byte[IHostProtection.ResetTokenBytes];
        protection.WriteResetToken(sessionId, token);
        return new Token128(token);
    }
}
