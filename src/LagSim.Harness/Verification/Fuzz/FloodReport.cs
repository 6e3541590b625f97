namespace LagSim.Harness.Verification.Fuzz;

/// <summary>The results of a flood over real sockets against a host and a client.</summary>
/// <param name="Seconds">How long it lasted.</param>
/// <param name="GarbageSent">The datagrams from a stranger: noise, and imitations of the protocol.</param>
/// <param name="ReplaysSent">The session's own datagrams, replayed from their true addresses.</param>
/// <param name="Received">The datagrams that both peers received, without those dropped by a full socket.</param>
/// <param name="Malformed">The datagrams refused by a decoder.</param>
/// <param name="Ignored">The datagrams that were well-formed but not meant for their receiver.</param>
/// <param name="EventsDone">The number of events that the two peers made meanwhile.</param>
/// <param name="EventsAgreed">The number of events that both have.</param>
/// <param name="RetainedBytes">How much the memory in use grew from the first fifth of the flood to its end, with both sessions
/// running.</param>
/// <param name="MaxLatenessMilliseconds">The furthest that shared time ran ahead of a simulated world, in milliseconds.</param>
/// <param name="Failure">The failure, as a sentence; null for none.</param>
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
