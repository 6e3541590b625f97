namespace LagSim.Harness.Relays;

/// <summary>What went through a relay so far.</summary>
/// <remarks>Immutable, safe on any thread. What is on its way is in none of the counts.</remarks>
/// <param name="Clients">How many have a way through.</param>
/// <param name="ForwardedToHost">How many datagrams were handed on to the host, copies included.</param>
/// <param name="LostToHost">How many of the clients' the profile lost.</param>
/// <param name="ForwardedFromHost">How many datagrams were handed on to clients, copies included.</param>
/// <param name="LostFromHost">How many of the host's the profile lost.</param>
/// <param name="Refused">How many had no way: from one client too many, or not from the host where only the host may send.</param>
/// <param name="PortChanges">How often the host was made to see a client at another port, all clients together.</param>
public readonly record struct RelayTraffic(
    int Clients, long ForwardedToHost, long LostToHost, long ForwardedFromHost, long LostFromHost, long Refused, long PortChanges = 0);
