namespace LagSim.Net.Sessions;

/// <summary>What a client has found out about a committed state that is not the host's.</summary>
public enum DivergenceFinding
{
    /// <summary>The host has been asked for its events, and has not told all of them yet.</summary>
    Asking = 0,

    /// <summary>
    /// An event of a player differs; <see cref="Divergence.HostVersion"/> and <see cref="Divergence.OwnVersion"/> are its two versions.
    /// </summary>
    EventDiffers = 1,

    /// <summary>
    ///  All events of players are the same on both: one of the two worlds made something else of them, or the hash that the host told is
    /// not its world's.
    /// </summary>
    EventsAgree = 2,

    /// <summary>The host or this peer no longer has all events of that time.</summary>
    Forgotten = 3,

    /// <summary>The host did not tell its events within the time-out.</summary>
    Unanswered = 4,

    /// <summary>The host was not asked: the strategy does not promise that worlds agree.</summary>
    NotPromised = 5,
}
