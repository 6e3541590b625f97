namespace LagSim.Net.Recordings;

/// <summary>The content of a record. The numbers are stored in files: never renumber.</summary>
internal enum RecordKind : byte
{
    /// <summary>The peer that recorded, and its session. The first record.</summary>
    Header = 1,

    /// <summary>The scene. The second record.</summary>
    Scene = 2,

    /// <summary>The initial state of a late client. The third record, or none.</summary>
    Joined = 3,

    /// <summary>An entry of the host's log.</summary>
    Entry = 4,

    /// <summary>The hashes of a committed state.</summary>
    Committed = 5,

    /// <summary>Why the recording ends. The last record; missing if the process was killed or the file was truncated.</summary>
    End = 6,
}
