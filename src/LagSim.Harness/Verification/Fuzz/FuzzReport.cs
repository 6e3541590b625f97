namespace LagSim.Harness.Verification.Fuzz;

/// <summary>What came of a run of hostile datagrams.</summary>
/// <param name="Packets">How many were sent.</param>
/// <param name="Sessions">How many sessions they were spread over, each from its first connect request on.</param>
/// <param name="Malformed">How many were refused by a decoder.</param>
/// <param name="Ignored">How many were well formed and no business of who got them. The rest could not be told from an honest
/// peer's.</param>
/// <param name="SessionsBroken">How many sessions ended or came apart under datagrams that bear a peer's own address and its session's
/// number: without encryption who can do that can do what the peer can. Under what strangers send none may.
/// </param>
/// <param name="StrangerBytesSent">What strangers sent to peers, without headers.</param>
/// <param name="StrangerBytesReceived">What they got in answer; never more.</param>
/// <param name="RetainedBytes">By how much the memory in use grew from the end of the first session to that of the last.</param>
/// <param name="SessionGrowthBytes">The most by which the memory in use grew while a session of strangers went on, of those looked
/// at.</param>
/// <param name="Failure">The first thing that must not be, as a sentence with the seed and the number of the packet; null for none.</param>
public sealed record FuzzReport(
    long Packets,
    int Sessions,
    long Malformed,
    long Ignored,
    int SessionsBroken,
    long StrangerBytesSent,
    long StrangerBytesReceived,
    long RetainedBytes,
    long SessionGrowthBytes,
    string? Failure);
