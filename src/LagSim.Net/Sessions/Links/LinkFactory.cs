using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Makes the links of a session, which share the buffers for composing updates.</summary>
internal sealed class LinkFactory
{
    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly SimDuration resendInterval;

    internal LinkFactory(SimDuration resendInterval) => this.resendInterval = resendInterval;

    /// <summary>The most bytes of updates a second over each link made from now on, UDP and IP headers included.</summary>
    internal double BytesPerSecond { get; set; } = double.PositiveInfinity;

    /// <summary>The factory of the parts of links made from now on.</summary>
    internal LinkParts Parts { get; set; } = new();

    /// <summary>Creates a link to a peer that has no number yet.</summary>
    /// <param name="other">Its address.</param>
    /// <param name="sessionId">The session id that every datagram of the link carries.</param>
    /// <param name="acknowledged">The last of this peer's entries that the other has without a gap.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="seal">Seals its datagrams; null in a session without protection.</param>
    internal UpdateLink To(PeerAddress other, ulong sessionId, uint acknowledged, SimTime now, LinkSeal? seal = null) =>
        new(new LinkEnds(sessionId, other, seal), acknowledged, resendInterval, outgoing, buffer, now, Parts, BytesPerSecond);
}
