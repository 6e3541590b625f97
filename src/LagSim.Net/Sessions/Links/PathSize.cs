using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>How long a datagram the path of a link is known to carry: the longest there is, or the least that every path carries.</summary>
/// <remarks>
/// A path with a small MTU that drops ICMP loses long datagrams and carries short ones (RFC 8899). A lossy link loses both, so it is
/// judged by long updates lost in a row, none of those sent between them having arrived, where a later short one did and no queue
/// explains it. At a loss of 15 %, more
/// than that of the worst link that is reported on, <see cref="Suspicious"/> in a row have a chance of 3 in 10 million.
/// </remarks>
internal sealed class PathSize
{
    private const int Suspicious = 8;

    private int lost;
    private uint arrived; // the newest long one that arrived; numbers begin at 1

    /// <summary>The longest datagram to send, sealed or not, without UDP and IP headers.</summary>
    internal int Bytes { get; set; } = WireFormat.MaxBytes;

    /// <summary>The longest datagram to send before it is sealed; the same without protection.</summary>
    internal int PlainBytes => Bytes - WireFormat.SealBytes;

    /// <summary>The most bytes that the entries of an update take.</summary>
    internal int UpdateRoom => PlainBytes - WireFormat.EmptyUpdateBytes - WireFormat.MaxHashBytes - WireFormat.StartBytes;

    /// <summary>The most bytes that the entries of an update take which every path carries.</summary>
    internal const int LeastUpdateRoom =
        WireFormat.LeastPathBytes - WireFormat.SealBytes - WireFormat.EmptyUpdateBytes - WireFormat.MaxHashBytes - WireFormat.StartBytes;

    /// <summary>Records that an update arrived, by its number, and its length with UDP and IP headers.</summary>
    internal void NoteArrived(uint number, int bytes)
    {
        if (IsLong(bytes) && number > arrived)
        {
            (lost, arrived) = (0, number);
        }
    }

    /// <summary>
    /// Records that an update was lost though a later one arrived, likewise. Losses are told after arrivals: one before a long update that
    /// arrived says nothing.
    /// </summary>
    internal void NoteLost(uint number, int bytes)
    {
        lost += IsLong(bytes) && number > arrived ? 1 : 0;
        if (lost >= Suspicious)
        {
            Bytes = WireFormat.LeastPathBytes;
        }
    }

    private static bool IsLong(int bytes) => bytes > WireFormat.LeastPathBytes + CongestionControl.DatagramOverhead;
}
