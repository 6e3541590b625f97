using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Makes the links of a session, which share what updates are composed in.</summary>
internal sealed class LinkFactory
{
    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] buffer = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly SimDuration resendInterval;

    internal LinkFactory(SimDuration resendInterval) => this.resendInterval = resendInterval;

    /// <summary>What makes the parts of the links that are made from now on.</summary>
    internal LinkParts Parts { get; set; } = new();

    /// <summary>A link to a peer that has no number yet.</summary>
    /// <param name="other">Where it is.</param>
    /// <param name="sessionId">What every datagram of the link bears.</param>
    /// <param name="acknowledged">The other has this peer's entries up to this one.</param>
    /// <param name="now">By the own clock.</param>
    internal UpdateLink To(PeerAddress other, ulong sessionId, uint acknowledged, SimTime now) =>
        new(sessionId, 0, 0, other, acknowledged, resendInterval, outgoing, buffer, now, Parts);
}
