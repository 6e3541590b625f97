namespace LagSim.Net.Sessions;

/// <summary>The cause of a differing committed state, as far as a client has found it.</summary>
public enum DivergenceFinding
{
    /// <summary>The host has been asked for its events, and has not sent all of them yet.</summary>
    Asking = 0,

    /// <summary>
    /// A player event differs; <see cref="Divergence.HostVersion"/> and <see cref="Divergence.OwnVersion"/> are its two versions.
    /// </summary>
    EventDiffers = 1,

    /// <summary>
    /// All player events are the same on both sides: the two worlds simulated them differently, or the host's reported hash is not its
    /// world's.
    /// </summary>
    EventsAgree = 2,

    /// <summary>The host or this peer no longer has all events of that time.</summary>
    Forgotten = 3,

    /// <summary>The host did not send its events within the timeout.</summary>
    Unanswered = 4,

    /// <summary>The host was not asked, because the strategy does not promise that worlds agree.</summary>
    NotPromised = 5,
}
