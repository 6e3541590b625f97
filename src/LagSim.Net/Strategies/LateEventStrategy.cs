namespace LagSim.Net.Strategies;

/// <summary>What a peer does with an accepted event of another peer, which usually comes late.</summary>
public enum LateEventStrategy
{
    /// <summary>
    /// The event happens at its own time; what it can have touched since, and only that, is simulated again. All peers agree, bit for bit.
    /// </summary>
    Healing,

    /// <summary>
    /// The event happens at its own time; everything since is simulated again. All peers agree, bit for bit, and every late event costs as
    /// much.
    /// </summary>
    FullRollback,

    /// <summary>
    /// As <see cref="Healing"/>, but what is shown lies <see cref="Sessions.SessionOptions.DisplayDelay"/> behind, so that most events have
    /// come before they are drawn and nothing jumps. What a player does itself shows that much later.
    /// </summary>
    Interpolation,

    /// <summary>
    /// The thesis's way: on arrival the body is put where it would be by its own motion had the event come in time. What it would have met
    /// in between is lost, and with it the agreement of the peers.
    /// </summary>
    LatencyForward,

    /// <summary>No compensation: the event happens when it arrives. The worlds of the peers then differ for good.</summary>
    ApplyOnArrival,
}
