namespace LagSim.Net.Wire;

/// <summary>The type of a datagram; its fourth byte. Never renumber.</summary>
internal enum DatagramType : byte
{
    /// <summary>No datagram.</summary>
    None = 0,

    /// <summary>A <see cref="ConnectRequestDatagram"/>: asks whether a host is there. The same in every version.</summary>
    ConnectRequest = 1,

    /// <summary>A <see cref="WelcomeDatagram"/>: lets a client in.</summary>
    Welcome = 2,

    /// <summary>A <see cref="RefusalDatagram"/>: refuses a client, with the reason. The same in every version.</summary>
    Refusal = 3,

    /// <summary>An <see cref="UpdateDatagram"/>: clock, acknowledgements, events.</summary>
    Update = 4,

    /// <summary>A <see cref="LeaveDatagram"/>: ends a peer's part in the session.</summary>
    Leave = 5,

    /// <summary>A <see cref="ChallengeDatagram"/>: asks for proof of an address, to join.</summary>
    Challenge = 6,

    /// <summary>A <see cref="JoinDatagram"/>: asks to be let in.</summary>
    Join = 7,

    /// <summary>A <see cref="SnapshotRequestDatagram"/>: requests chunks of the snapshot.</summary>
    SnapshotRequest = 8,

    /// <summary>A <see cref="SnapshotChunkDatagram"/>: a chunk of scene and world.</summary>
    SnapshotChunk = 9,

    /// <summary>A <see cref="DesyncQueryDatagram"/>: reports a state that differs, and asks for the host's events.</summary>
    DesyncQuery = 10,

    /// <summary>An <see cref="DesyncReportDatagram"/>: one of those events.</summary>
    DesyncReport = 11,

    /// <summary>A <see cref="SeatDatagram"/>: gives a client its player number.</summary>
    Seat = 12,

    /// <summary>A <see cref="MoveDatagram"/>: announces a new address.</summary>
    Move = 13,

    /// <summary>A <see cref="MoveChallengeDatagram"/>: asks for proof of a new address.</summary>
    MoveChallenge = 14,

    /// <summary>A <see cref="SecureJoinDatagram"/>: asks to be let in, encrypted.</summary>
    SecureJoin = 15,

    /// <summary>A <see cref="SecureAnswerDatagram"/>: lets a client in, encrypted.</summary>
    SecureWelcome = 16,

    /// <summary>A <see cref="SecureAnswerDatagram"/>: refuses a client, with the reason, encrypted.</summary>
    SecureRefusal = 17,

    /// <summary>A <see cref="ResetDatagram"/>: a host proves that it does not have a client any more.</summary>
    Reset = 18,

    /// <summary>A <see cref="SealedDatagram"/>: another datagram of a link, encrypted.</summary>
    Sealed = 19,

    /// <summary>A <see cref="RosterDatagram"/>: who has which number.</summary>
    Roster = 20,

    /// <summary>A <see cref="RosterReceivedDatagram"/>: acknowledges that.</summary>
    RosterReceived = 21,

    /// <summary>A <see cref="KeyExchangeDatagram"/>: a client offers to exchange a link's keys for fresh ones.</summary>
    KeyExchange = 22,

    /// <summary>A <see cref="KeyExchangeDatagram"/>: the host's answer to that.</summary>
    KeyExchangeReply = 23,
}
