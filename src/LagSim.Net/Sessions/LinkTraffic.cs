using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The traffic over the link to one other peer so far, and its round trip.</summary>
/// <remarks>A copy: immutable, safe on any thread.</remarks>
public sealed class LinkTraffic
{
    internal LinkTraffic(byte peer, PeerAddress address, long datagramsSent, long bytesSent, long datagramsReceived, long bytesReceived, SimDuration roundTrip, SimDuration queueing)
    {
        Peer = peer;
        Address = address;
        DatagramsSent = datagramsSent;
        BytesSent = bytesSent;
        DatagramsReceived = datagramsReceived;
        BytesReceived = bytesReceived;
        RoundTrip = roundTrip;
        Queueing = queueing;
    }

    /// <summary>The other peer's number; 0 is the host.</summary>
    public byte Peer { get; }

    /// <summary>The other peer's address.</summary>
    public PeerAddress Address { get; }

    /// <summary>The number of datagrams sent to it.</summary>
    public long DatagramsSent { get; }

    /// <summary>The number of bytes sent in datagrams, without UDP and IP headers, 28 bytes each over IPv4.</summary>
    public long BytesSent { get; }

    /// <summary>The number of valid datagrams received from it.</summary>
    public long DatagramsReceived { get; }

    /// <summary>The number of bytes received in those.</summary>
    public long BytesReceived { get; }

    /// <summary>The newest round trip, without the time spent at the other peer; zero before there is one.</summary>
    public SimDuration RoundTrip { get; }

    /// <summary>
    /// How much of recent round trips was spent waiting in a queue, in either direction; zero where that is negligible. While there is a
    /// queue, this end repeats nothing and puts more into each datagram.
    /// </summary>
    public SimDuration Queueing { get; }
}
