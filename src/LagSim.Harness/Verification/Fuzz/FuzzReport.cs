namespace LagSim.Harness.Verification.Fuzz;

/// <summary>The results of a run of hostile datagrams.</summary>
/// <param name="Packets">The number of datagrams sent.</param>
/// <param name="Sessions">The number of sessions they were spread over, each from its first connect request on.</param>
/// <param name="Malformed">The number refused by a decoder.</param>
/// <param name="Ignored">The number that were well-formed but not meant for their receiver. The rest were indistinguishable from an honest
/// peer's.</param>
/// <param name="Forged">The number that a protected session refused because nobody of it had sealed them.</param>
/// <param name="SessionsBroken">The number of sessions that ended or diverged under datagrams with a peer's own address and its session's
/// number. Without protection, a sender that can forge those can do what the peer can; of protected sessions none may break. Datagrams from
/// strangers may break none.</param>
/// <param name="StrangerBytesSent">The bytes that strangers sent to peers, without headers.</param>
/// <param name="StrangerBytesReceived">The bytes that strangers got in reply; never more.</param>
/// <param name="RetainedBytes">How much the memory in use grew from the end of the first session to that of the last.</param>
/// <param name="SessionGrowthBytes">The largest growth of the memory in use during a session under strangers' datagrams, of those
/// measured.</param>
/// <param name="Failure">The first failure, as a sentence with the seed and the number of the datagram; null for none.</param>
public sealed record FuzzReport(
    long Packets,
    int Sessions,
    long Malformed,
    long Ignored,
    long Forged,
    int SessionsBroken,
    long StrangerBytesSent,
    long StrangerBytesReceived,
    long RetainedBytes,
    long SessionGrowthBytes,
    string? Failure);
