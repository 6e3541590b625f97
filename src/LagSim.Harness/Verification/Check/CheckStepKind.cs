namespace LagSim.Harness.Verification.Check;

/// <summary>The kinds of steps in a drawn session.</summary>
internal enum CheckStepKind
{
    /// <summary>A player asks to join.</summary>
    Ask,

    /// <summary>A player leaves, or is killed.</summary>
    Leave,

    /// <summary>A player's process stalls.</summary>
    Stop,

    /// <summary>The process resumes.</summary>
    GoOn,

    /// <summary>A player acts.</summary>
    Act,

    /// <summary>The session ends.</summary>
    End,
}
