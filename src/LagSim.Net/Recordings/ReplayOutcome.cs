namespace LagSim.Net.Recordings;

/// <summary>What a <see cref="RecordingReplay"/> found.</summary>
public enum ReplayOutcome
{
    /// <summary>Every committed state has the hashes that were recorded; there is at least one.</summary>
    Agrees,

    /// <summary>A committed state has other hashes than were recorded.</summary>
    Differs,

    /// <summary>The recording has no committed state that could be checked.</summary>
    NothingToCheck,

    /// <summary>The recording cannot be run again, or not up to its last committed state.</summary>
    CannotRun,
}
