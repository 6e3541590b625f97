namespace LagSim.Net.Sessions;

/// <summary>Why a session ended, for programs; <see cref="Session.EndReason"/> is for people.</summary>
public enum SessionEnd
{
    /// <summary>The session has not ended.</summary>
    None,

    /// <summary>This peer left; a host thereby ended the session.</summary>
    Left,

    /// <summary>The host ended the session properly, for all peers.</summary>
    HostEnded,

    /// <summary>The host did not let this client in: another version, key or scene, or no free place.</summary>
    Refused,

    /// <summary>Nothing arrived from the host within the timeout.</summary>
    HostSilent,

    /// <summary>The host disconnected this client, because it was silent or did not keep up.</summary>
    Disconnected,

    /// <summary>
    /// The part of this peer's world that may still change exceeds <see cref="SessionOptions.MaxSegments"/>, and did so again in fresh
    /// snapshots.
    /// </summary>
    TimelinesFull,

    /// <summary>The link is too slow for the session: even fresh snapshots were out of date at once.</summary>
    LinkTooSlow,

    /// <summary>The host's data does not make a world, or the world cannot be simulated any further.</summary>
    Failed,

    /// <summary>The host sent this player away.</summary>
    Kicked,

    /// <summary>The host's world cannot be simulated any further, or its session failed otherwise; it is over for all peers.</summary>
    HostFailed,
}
