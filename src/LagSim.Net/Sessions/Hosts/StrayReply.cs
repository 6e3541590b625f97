using System;
using System.Buffers.Binary;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Tells a sender that it missed the goodbye or never was a client of this host, with the session id of its own datagram, in fewer bytes
/// than it sent.
/// </summary>
/// <param name="places">Why clients are gone.</param>
/// <param name="status">Whether the session has ended.</param>
/// <param name="protection">Proves the host to the sender; null in a session without protection.</param>
/// <param name="sender">Sends the reply.</param>
/// <param name="clock">The local clock.</param>
internal sealed class StrayReply(
    PlayerPlaces places, SessionStatus status, IHostProtection? protection, DatagramSender sender, IClock clock)
{
    /// <summary>
    /// The rate of replies that prove the host, and their burst: each takes three hashes and some memory, and anybody can ask for them. Who
    /// gets none waits for the timeout.
    /// </summary>
    private const int ProofsPerSecond = 1000;

    private readonly RateLimit proofs = new(ProofsPerSecond, ProofsPerSecond, clock.Now);

    internal void Send(PeerAddress to, ulong sessionId)
    {
        LeaveReason reason = !status.HasEnded ? places.WhyGone(sessionId)
            : status.EndedBy == SessionEnd.Left ? LeaveReason.HostEnded
            : LeaveReason.HostFailed;
        Span<byte> bytes = stackalloc byte[WireFormat.ResetBytes];
        if (protection is null)
        {
            sender.Send(bytes.Slice(0, new LeaveDatagram(sessionId, 0, reason).Encode(bytes)), to);
            return;
        }

        if (!proofs.TrySpend(clock.Now))
        {
            return;
        }

        Token128 proof = ResetDatagram.Prove(Key(protection, sessionId, sender.LocalAddress), reason);
        sender.Send(bytes.Slice(0, new ResetDatagram(sessionId, reason, proof).Encode(bytes)), to);
    }

    /// <summary>
    /// The key by which a host proves to the client with that session id that it does not have it any more. The host's address is part of
    /// it: another host with the same identity has another port, and cannot be made to say it of this one's clients.
    /// </summary>
    internal static Token128 Key(IHostProtection protection, ulong sessionId, PeerAddress host)
    {
        Span<byte> link = stackalloc byte[sizeof(ulong) + PeerAddress.Bytes];
        BinaryPrimitives.WriteUInt64LittleEndian(link, sessionId);
        host.Write(link.Slice(sizeof(ulong)));
        Span<byte> key = stackalloc byte[IHostProtection.ResetKeyBytes];
        protection.WriteResetKey(link, key);
        return new Token128(key);
    }
}
