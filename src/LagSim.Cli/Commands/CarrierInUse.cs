using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;

namespace LagSim.Cli.Commands;

/// <summary>The carrier that a session runs over, and what it has counted.</summary>
/// <param name="Port">The carrier. The session's thread uses it; it is disposed by who made it.</param>
/// <param name="Counts">What it counts, by the keys of the summary.</param>
internal sealed record CarrierInUse(IDatagramPort Port, Func<IEnumerable<(string Name, long Count)>> Counts)
{
    /// <summary>Why the host cannot be reached, as a sentence; null where the carrier does not know, or nothing is wrong.</summary>
    internal Func<string?> Obstacle { get; private init; } = () => null;

    /// <summary>UDP alone.</summary>
    internal static CarrierInUse Of(UdpPort port) => new(port, () => CountsOf(port.Dropped, port.SendFailures, port.ReceiveFailures, 0));

    /// <summary>A WebSocket to a host.</summary>
    internal static CarrierInUse Of(WebSocketClientPort port) =>
        new(port, () => CountsOf(port.Dropped, port.Unconnected, 0, port.Superseded)) { Obstacle = () => port.Failure };

    /// <summary>UDP, and WebSockets beside it.</summary>
    internal static CarrierInUse Of(UdpPort udp, WebSocketHostPort web) =>
        new(new MultiplexPort(udp, web), () => CountsOf(
            udp.Dropped + web.Dropped, udp.SendFailures + web.Unconnected, udp.ReceiveFailures, web.Superseded)
            .Append(("connections_blocked", web.Blocked)));

    private static IEnumerable<(string Name, long Count)> CountsOf(long dropped, long unsent, long broken, long superseded) =>
    [
        ("datagrams_dropped", dropped), ("send_failures", unsent), ("receive_failures", broken), ("datagrams_superseded", superseded),
    ];
}
