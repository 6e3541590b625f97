using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Hands a session's datagrams to the port and counts them. Every datagram a session sends goes through here.</summary>
internal sealed class DatagramSender(IDatagramPort port, SessionCounters counters)
{
    /// <summary>
    /// The number of goodbyes sent at once. A peer that misses them all gets another in reply to whatever it sends, for as long as the port
    /// is open.
    /// </summary>
    internal const int Goodbyes = 3;

    internal void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        port.Send(datagram, to);
        counters.DatagramsSent++;
    }

    internal void Send(ReadOnlySpan<byte> datagram, UpdateLink link)
    {
        Send(datagram, link.Other);
        link.CountSent(datagram.Length);
    }

    /// <summary>Informs the other end of a link that it is over.</summary>
    /// <param name="link">The link.</param>
    /// <param name="self">This peer's number.</param>
    /// <param name="reason">The reason.</param>
    internal void SayGoodbye(UpdateLink link, byte self, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(link.SessionId, self, reason).Encode(bytes)), link);
    }

    /// <summary>Informs a sender without a link that it has none, using the session id from its own datagram.</summary>
    internal void SayGoodbye(PeerAddress to, ulong itsSession, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(itsSession, 0, reason).Encode(bytes)), to);
    }
}
