namespace LagSim.Net.Strategies;

/// <summary>How a peer handles an accepted event of another peer, which usually arrives late.</summary>
public enum LateEventStrategy
{
    /// <summary>
    /// The event happens at its own time; only what it can have touched since is simulated again. All peers agree, bit for bit.
    /// </summary>
    Healing,

    /// <summary>
    /// The event happens at its own time; everything since is simulated again. All peers agree, bit for bit, and every late event costs
    /// that much.
    /// </summary>
    FullRollback,

    /// <summary>
    /// As <see cref="Healing"/>, but shown <see cref="Sessions.SessionOptions.DisplayDelay"/> behind, so that most events arrive before
    /// they are drawn and nothing jumps. A player's own actions show that much later.
    /// </summary>
    Interpolation,

    /// <summary>
    /// The thesis's method: on arrival the body is put where its own motion would have taken it had the event come in time. Contacts with
    /// other bodies in between are lost, and with them the agreement of the peers.
    /// </summary>
    LatencyForward,

    /// <summary>No compensation: the event happens when it arrives. The worlds of the peers then differ for good.</summary>
    ApplyOnArrival,
}
