namespace LagSim.Net.Wire;

/// <summary>Why a peer is no longer in the session. Never renumber.</summary>
internal enum LeaveReason : byte
{
    /// <summary>It left on its own.</summary>
    Left = 1,

    /// <summary>It was silent for too long.</summary>
    TimedOut = 2,

    /// <summary>The host ended the session, for all peers.</summary>
    HostEnded = 3,

    /// <summary>It fell behind the log: events came faster than it took them in.</summary>
    FellBehind = 4,

    /// <summary>A client with the same player's key joined from elsewhere.</summary>
    Replaced = 5,

    /// <summary>It is not, or no longer, among the host's clients; the answer to an update from a sender that assumes it is.</summary>
    NotJoined = 6,

    /// <summary>The host sent it away: <see cref="Sessions.HostSession.Kick"/> or <see cref="Sessions.HostSession.Ban"/>.</summary>
    Kicked = 7,

    /// <summary>The host's world ended, or its session failed otherwise: the session is over for all peers.</summary>
    HostFailed = 8,

    /// <summary>It left on its own and may come back: the host keeps its number for it, as for one that fell silent.</summary>
    Away = 9,

    /// <summary>Its link got no fresh keys for too long (<see cref="Sessions.Links.LinkKeys.MaxAge"/>).</summary>
    KeysTooOld = 10,
}
