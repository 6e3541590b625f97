using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>What went over the link to one other peer so far, and how long it takes there and back.</summary>
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

    /// <summary>Where it is.</summary>
    public PeerAddress Address { get; }

    /// <summary>How many datagrams were sent there.</summary>
    public long DatagramsSent { get; }

    /// <summary>How many bytes, of datagrams alone: without what UDP and IP add, 28 bytes each over IPv4.</summary>
    public long BytesSent { get; }

    /// <summary>How many valid datagrams came from there.</summary>
    public long DatagramsReceived { get; }

    /// <summary>How many bytes those had.</summary>
    public long BytesReceived { get; }

    /// <summary>The newest round trip, without the time spent at the other peer; zero before there is one.</summary>
    public SimDuration RoundTrip { get; }

    /// <summary>
    ///  How much of the round trips of late is waiting in a queue, in one direction or the other; zero where there is none worth speaking
    /// of. While there is one, this end repeats nothing and puts more into each datagram.
    /// </summary>
    public SimDuration Queueing { get; }
}
