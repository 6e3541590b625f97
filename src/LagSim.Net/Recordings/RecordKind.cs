namespace LagSim.Net.Recordings;

/// <summary>What a record of a recording holds. The numbers stand in files: never renumber.</summary>
internal enum RecordKind : byte
{
    /// <summary>Who recorded, and which session. The first record.</summary>
    Header = 1,

    /// <summary>The scene. The second record.</summary>
    Scene = 2,

    /// <summary>The state with which a late client began. The third record, or none.</summary>
    Joined = 3,

    /// <summary>An entry of the host's log.</summary>
    Entry = 4,

    /// <summary>The hashes of a committed state.</summary>
    Committed = 5,

    /// <summary>Why the recording ends. The last record; missing where the process was killed or the file was cut.</summary>
    End = 6,
}
