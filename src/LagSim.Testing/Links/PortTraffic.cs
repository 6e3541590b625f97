namespace LagSim.Testing.Links;

/// <summary>The traffic through a port so far, as the wire sees it: the bytes of each datagram and of its headers.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
/// <param name="DatagramsSent">The datagrams handed to the network, including those it then lost.</param>
/// <param name="BytesSent">Their bytes, with <see cref="HeaderBytes"/> for each.</param>
/// <param name="DatagramsReceived">The datagrams that arrived, copies included.</param>
/// <param name="BytesReceived">Their bytes, with <see cref="HeaderBytes"/> for each.</param>
public readonly record struct PortTraffic(long DatagramsSent, long BytesSent, long DatagramsReceived, long BytesReceived)
{
    /// <summary>The bytes of headers on each datagram: 20 for IPv4, 8 for UDP.</summary>
    public const int HeaderBytes = 28;

    internal PortTraffic WithSent(int datagramBytes) =>
        this with { DatagramsSent = DatagramsSent + 1, BytesSent = BytesSent + datagramBytes + HeaderBytes };

    internal PortTraffic WithReceived(int datagramBytes) =>
        this with { DatagramsReceived = DatagramsReceived + 1, BytesReceived = BytesReceived + datagramBytes + HeaderBytes };
}
