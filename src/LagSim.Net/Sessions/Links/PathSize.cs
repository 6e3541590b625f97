using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Links;

/// <summary>How long a datagram the path of a link is known to carry: the longest there is, or the least that every path carries.</summary>
/// <remarks>
/// A path with a small MTU that drops ICMP loses long datagrams and carries short ones (RFC 8899). A lossy link loses both, so it is
/// judged by long updates lost in a row, each overtaken by a short one that arrived, where no queue explains it. At a loss of 15 %, more
/// than that of the worst link that is reported on, <see cref="Suspicious"/> in a row have a chance of 3 in 10 million.
/// </remarks>
internal sealed class PathSize
{
    private const int Suspicious = 8;

    private int lost;

    /// <summary>The longest datagram to send, sealed or not, without UDP and IP headers.</summary>
    internal int Bytes { get; set; } = WireFormat.MaxBytes;

    /// <summary>The longest datagram to send before it is sealed; the same without protection.</summary>
    internal int PlainBytes => Bytes - WireFormat.SealBytes;

    /// <summary>The most bytes that the entries of an update take.</summary>
    internal int UpdateRoom => PlainBytes - WireFormat.EmptyUpdateBytes - WireFormat.MaxHashBytes - WireFormat.StartBytes;

    /// <summary>Records that an update arrived, by its length with UDP and IP headers.</summary>
    internal void NoteArrived(int bytes) => lost = IsLong(bytes) ? 0 : lost;

    /// <summary>Records that an update was lost though a later one arrived, by its length with UDP and IP headers.</summary>
    internal void NoteLost(int bytes)
    {
        lost += IsLong(bytes) ? 1 : 0;
        if (lost >= Suspicious)
        {
            Bytes = WireFormat.LeastPathBytes;
        }
    }

    private static bool IsLong(int bytes) => bytes > WireFormat.LeastPathBytes + CongestionControl.DatagramOverhead;
}
