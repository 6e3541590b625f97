namespace LagSim.Net.Wire;

/// <summary>What a datagram is; the fourth byte of each. Never renumber.</summary>
internal enum DatagramType : byte
{
    /// <summary>No datagram.</summary>
    None = 0,

    /// <summary>A <see cref="ConnectRequestDatagram"/>: are you there? In every version.</summary>
    ConnectRequest = 1,

    /// <summary>A <see cref="WelcomeDatagram"/>: you are in.</summary>
    Welcome = 2,

    /// <summary>A <see cref="RefusalDatagram"/>: you are not, because. In every version.</summary>
    Refusal = 3,

    /// <summary>An <see cref="UpdateDatagram"/>: clock, acknowledgements, events.</summary>
    Update = 4,

    /// <summary>A <see cref="LeaveDatagram"/>: this is over.</summary>
    Leave = 5,

    /// <summary>A <see cref="ChallengeDatagram"/>: bring this back, to come in, or to show that an address is yours.</summary>
    Challenge = 6,

    /// <summary>A <see cref="JoinDatagram"/>: let me in.</summary>
    Join = 7,

    /// <summary>A <see cref="SnapshotRequestDatagram"/>: send me these pieces.</summary>
    SnapshotRequest = 8,

    /// <summary>A <see cref="SnapshotChunkDatagram"/>: a piece of scene and world.</summary>
    SnapshotChunk = 9,

    /// <summary>A <see cref="DesyncQueryDatagram"/>: my world is not yours; which events do you have?</summary>
    DesyncQuery = 10,

    /// <summary>An <see cref="DesyncReportDatagram"/>: this one.</summary>
    DesyncReport = 11,

    /// <summary>A <see cref="SeatDatagram"/>: you are this player.</summary>
    Seat = 12,

    /// <summary>A <see cref="MoveDatagram"/>: this is my address now.</summary>
    Move = 13,
}
