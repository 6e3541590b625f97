namespace LagSim.Timelines;

/// <summary>What is re-simulated for a late event.</summary>
internal enum RollbackKind
{
    /// <summary>Nothing: no rollback is under way.</summary>
    None,

    /// <summary>What depends on the late event. The paths of other bodies are known beyond the current event.</summary>
    CausalCone,

    /// <summary>All bodies; no path is known beyond the current event.</summary>
    Full,
}
