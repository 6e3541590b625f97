namespace LagSim.Net.Recordings;

/// <summary>The outcome of a <see cref="RecordingComparison"/>.</summary>
public enum ComparisonOutcome
{
    /// <summary>Everything that both contain is equal, including at least one committed state.</summary>
    Agrees,

    /// <summary>The scenes differ: the recordings are of different worlds.</summary>
    SceneDiffers,

    /// <summary>The starts differ: the recordings are of different sessions.</summary>
    StartDiffers,

    /// <summary>An entry of the log differs, in its event or its verdict.</summary>
    EventDiffers,

    /// <summary>The log is the same where both contain it, and a committed state differs.</summary>
    StateDiffers,

    /// <summary>No committed time is in both, whichever log entries are equal, or one of them has no valid header.</summary>
    NothingInCommon,

    /// <summary>
    /// The fold versions differ: the two libraries produce different states from the same scene and events, so their hashes cannot be
    /// compared.
    /// </summary>
    FoldVersionDiffers,
}
