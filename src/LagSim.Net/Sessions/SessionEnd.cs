namespace LagSim.Net.Sessions;

/// <summary>What ended a session, for programs; <see cref="Session.EndReason"/> is for people.</summary>
public enum SessionEnd
{
    /// <summary>It goes on.</summary>
    None,

    /// <summary>This peer left, or as the host ended it.</summary>
    Left,

    /// <summary>The host ended it, in order, for everyone.</summary>
    HostEnded,

    /// <summary>The host did not let this client in: another version, key or scene, or no place.</summary>
    Refused,

    /// <summary>Nothing came from the host for the timeout.</summary>
    HostSilent,

    /// <summary>The host gave this client up: it heard nothing of it, or it did not keep up.</summary>
    Disconnect,

    /// <summary>
    /// What may still change of this peer's world is more than <see cref="SessionOptions.MaxSegments"/>, and was again in fresh copies of
    /// it.
    /// </summary>
    TimelinesFull,

    /// <summary>
    /// What happens in the session is more than the link carries: even fresh copies of the world were out of date again at once.
    /// </summary>
    LinkTooSlow,

    /// <summary>What the host sent makes no world, or the world cannot be simulated any further.</summary>
    Failed,

    /// <summary>The host sent this player away.</summary>
    Kicked,
}
