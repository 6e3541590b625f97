using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Hands a session's datagrams to the port, sealed where their link is, and counts them. Every datagram a session sends goes through here.
/// </summary>
internal sealed class DatagramSender(IDatagramPort port, SessionCounters counters)
{
    /// <summary>
    /// The number of goodbyes sent at once. A peer that misses them all gets another in reply to whatever it sends, for as long as the port
    /// is open.
    /// </summary>
    internal const int Goodbyes = 3;

    private readonly byte[] sealing = new byte[WireFormat.MaxBytes];

    /// <summary>Where this peer listens.</summary>
    internal PeerAddress LocalAddress => port.LocalAddress;

    /// <summary>Sends a datagram that belongs to no link, as it is.</summary>
    internal void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        port.Send(datagram, to);
        counters.DatagramsSent++;
    }

    /// <summary>Sends a datagram over a link.</summary>
    internal void Send(ReadOnlySpan<byte> datagram, UpdateLink link) => Send(datagram, link, link.Other);

    /// <summary>
    /// Sends a datagram of a link to an address that may not be the other end's. Over a link whose keys are wiped nothing goes.
    /// </summary>
    internal void Send(ReadOnlySpan<byte> datagram, UpdateLink link, PeerAddress to)
    {
        if (link.Seal is { IsWiped: true })
        {
            return; // a handler ended the link in the middle of what it was called for
        }

        ReadOnlySpan<byte> bytes = link.Seal is LinkSeal seal ? sealing.AsSpan(0, seal.Seal(datagram, sealing)) : datagram;
        Send(bytes, to);
        link.CountSent(bytes.Length);
    }

    /// <summary>Informs the other end of a link that it is over.</summary>
    /// <param name="link">The link.</param>
    /// <param name="self">This peer's number.</param>
    /// <param name="reason">The reason.</param>
    /// <param name="sentence">What failed, or why it is sent away, where that is the reason.</param>
    internal void SayGoodbye(UpdateLink link, byte self, LeaveReason reason, string sentence = "")
    {
        Span<byte> bytes = stackalloc byte[WireFormat.MaxLeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(link.SessionId, self, reason, sentence).Encode(bytes)), link);
    }
}
