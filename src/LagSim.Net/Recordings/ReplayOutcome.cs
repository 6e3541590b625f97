namespace LagSim.Net.Recordings;

/// <summary>The outcome of a <see cref="RecordingReplay"/>.</summary>
public enum ReplayOutcome
{
    /// <summary>Every committed state has the recorded hashes; there is at least one.</summary>
    Agrees,

    /// <summary>A committed state has hashes other than the recorded ones.</summary>
    Differs,

    /// <summary>The recording has no committed state that could be checked.</summary>
    NothingToCheck,

    /// <summary>The recording cannot be replayed, or not up to its last committed state.</summary>
    CannotRun,
}
