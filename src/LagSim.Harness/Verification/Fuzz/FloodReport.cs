namespace LagSim.Harness.Verification.Fuzz;

/// <summary>The results of a flood over real sockets against a host and a client.</summary>
public sealed record FloodReport
{
    /// <summary>How long it lasted.</summary>
    public double Seconds { get; init; }

    /// <summary>The datagrams from a stranger: noise, and imitations of the protocol.</summary>
    public long GarbageSent { get; init; }

    /// <summary>The session's own datagrams, replayed from their true addresses.</summary>
    public long ReplaysSent { get; init; }

    /// <summary>The datagrams of machines that are there: requests for cookies, and joins of noise with a good cookie.</summary>
    public long JoinsSent { get; init; }

    /// <summary>The datagrams that host and client received, without those dropped by a full socket.</summary>
    public long Received { get; init; }

    /// <summary>The datagrams refused by a decoder.</summary>
    public long Malformed { get; init; }

    /// <summary>The datagrams that were well-formed but not meant for their receiver.</summary>
    public long Ignored { get; init; }

    /// <summary>The datagrams that had the form of sealed ones or of handshakes, and were not.</summary>
    public long Forged { get; init; }

    /// <summary>The number of events that the two peers made meanwhile.</summary>
    public long EventsDone { get; init; }

    /// <summary>The number of events that both have.</summary>
    public long EventsAgreed { get; init; }

    /// <summary>How long a client that joined during the flood took to be in, in seconds; null if it did not get in.</summary>
    public double? JoinSeconds { get; init; }

    /// <summary>How much the memory in use grew from the first fifth of the flood to its end, with the sessions running.</summary>
    public long RetainedBytes { get; init; }

    /// <summary>The furthest that shared time ran ahead of a simulated world, in milliseconds.</summary>
    public double MaxLatenessMilliseconds { get; init; }

    /// <summary>The failure, as a sentence; null for none.</summary>
    public string? Failure { get; init; }
}
