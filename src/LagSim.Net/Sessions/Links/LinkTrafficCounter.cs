using LagSim.Net.Carriers;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Counts what goes over a link, both ways.</summary>
internal sealed class LinkTrafficCounter
{
    private long datagramsSent;
    private long bytesSent;
    private long datagramsReceived;
    private long bytesReceived;

    internal void CountReceived(int bytes)
    {
        datagramsReceived++;
        bytesReceived += bytes;
    }

    internal void CountSent(int bytes)
    {
        datagramsSent++;
        bytesSent += bytes;
    }

    /// <summary>Returns the traffic counted so far.</summary>
    internal LinkTraffic Of(byte peer, PeerAddress other, RoundTrips trips) => new(
        peer, other, datagramsSent, bytesSent, datagramsReceived, bytesReceived, trips.Newest,
        trips.HasQueue ? trips.Queueing : SimDuration.Zero);
}
