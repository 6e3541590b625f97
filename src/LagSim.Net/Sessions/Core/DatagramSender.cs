using System;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>The one way by which a session's datagrams go out: it hands them to the port and counts them.</summary>
internal sealed class DatagramSender(IDatagramPort port, SessionCounters counters)
{
    /// <summary>
    /// As often a goodbye is said at once; who has not heard it hears it again in answer to what it sends, for as long as the port is
    /// there.
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

    /// <summary>Tells the other end of a link that it is over.</summary>
    /// <param name="link">The link.</param>
    /// <param name="self">This peer's number.</param>
    /// <param name="reason">Why.</param>
    internal void SayGoodbye(UpdateLink link, byte self, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(link.SessionId, self, reason).Encode(bytes)), link);
    }

    /// <summary>Tells somebody to whom there is no link that it has none, by the session id that it gave itself.</summary>
    internal void SayGoodbye(PeerAddress to, ulong itsSession, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(itsSession, 0, reason).Encode(bytes)), to);
    }
}
