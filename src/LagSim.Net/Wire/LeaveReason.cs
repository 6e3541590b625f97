namespace LagSim.Net.Wire;

/// <summary>Why a peer is no longer in the session. Never renumber.</summary>
internal enum LeaveReason : byte
{
    /// <summary>It left of its own will.</summary>
    Left = 1,

    /// <summary>Nothing was heard of it for too long.</summary>
    TimedOut = 2,

    /// <summary>The host ended the session, for everyone.</summary>
    HostEnded = 3,

    /// <summary>It did not take in what happened as fast as it did.</summary>
    FellBehind = 4,

    /// <summary>Somebody with the key of the same player came in, from elsewhere.</summary>
    Replaced = 5,

    /// <summary>It is not, or no longer, among the host's clients; the answer to an update of somebody who thinks so.</summary>
    NotJoined = 6,

    /// <summary>The host sent it away: <see cref="Sessions.HostSession.Kick"/> or <see cref="Sessions.HostSession.Ban"/>.</summary>
    Kicked = 7,
}
