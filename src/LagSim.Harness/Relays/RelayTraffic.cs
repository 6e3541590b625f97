namespace LagSim.Harness.Relays;

/// <summary>The traffic of a relay so far.</summary>
/// <remarks>Immutable, safe on any thread. Datagrams in transit are in none of the counts.</remarks>
/// <param name="Clients">The number of clients.</param>
/// <param name="ForwardedToHost">The datagrams forwarded to the host, copies included.</param>
/// <param name="LostToHost">The datagrams of clients that the profile lost.</param>
/// <param name="ForwardedFromHost">The datagrams forwarded to clients, copies included.</param>
/// <param name="LostFromHost">The datagrams of the host that the profile lost.</param>
/// <param name="Refused">The datagrams refused: from a client over the limit, or from another sender than the host where only the host may
/// send.</param>
/// <param name="PortChanges">The changes of a client's port towards the host, all clients together.</param>
public readonly record struct RelayTraffic(
    int Clients, long ForwardedToHost, long LostToHost, long ForwardedFromHost, long LostFromHost, long Refused, long PortChanges = 0);
