namespace LagSim.Harness.Verification.Fuzz;

/// <summary>What a flood over real sockets did to a host and a client.</summary>
/// <param name="Seconds">How long it lasted.</param>
/// <param name="GarbageSent">Datagrams of a stranger: noise, and what looks like the protocol.</param>
/// <param name="ReplaysSent">True datagrams of the session, sent again from where they came.</param>
/// <param name="Received">How many datagrams both peers took in; what a full socket drops is not among them.</param>
/// <param name="Malformed">How many of those were refused by a decoder.</param>
/// <param name="Ignored">How many were well formed and no business of who got them.</param>
/// <param name="EventsDone">How many events the two peers did meanwhile.</param>
/// <param name="EventsAgreed">How many of them both have.</param>
/// <param name="RetainedBytes">By how much the memory in use grew from its first fifth to its end, both sessions going on.</param>
/// <param name="MaxLatenessMilliseconds">The furthest that shared time ran beyond what a world had been simulated to.</param>
/// <param name="Failure">What must not be, as a sentence; null for nothing.</param>
public sealed record FloodReport(
    double Seconds,
    long GarbageSent,
    long ReplaysSent,
    long Received,
    long Malformed,
    long Ignored,
    long EventsDone,
    long EventsAgreed,
    long RetainedBytes,
    double MaxLatenessMilliseconds,
    string? Failure);
