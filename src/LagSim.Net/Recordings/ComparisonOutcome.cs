namespace LagSim.Net.Recordings;

/// <summary>What a <see cref="RecordingComparison"/> found.</summary>
public enum ComparisonOutcome
{
    /// <summary>Everything that both cover is the same; there is at least one committed state that both hold.</summary>
    Agrees,

    /// <summary>The scenes differ: the recordings are of different worlds.</summary>
    SceneDiffers,

    /// <summary>The starts differ: the recordings are of different sessions.</summary>
    StartDiffers,

    /// <summary>An entry of the log differs, in its event or its verdict.</summary>
    EventDiffers,

    /// <summary>The log is the same where both cover it, and a committed state differs.</summary>
    StateDiffers,

    /// <summary>
    /// There is no committed time that both cover, whatever entries of the log are the same, or one of them has no sound header.
    /// </summary>
    NothingInCommon,

    /// <summary>
    /// The fold versions differ: the libraries that recorded make different states of the same scene and events, so no hash of one says
    /// anything of the other's.
    /// </summary>
    FoldVersionDiffers,
}
