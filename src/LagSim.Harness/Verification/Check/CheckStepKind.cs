namespace LagSim.Harness.Verification.Check;

/// <summary>What may happen in a drawn session.</summary>
internal enum CheckStepKind
{
    /// <summary>A player asks to be let in.</summary>
    Ask,

    /// <summary>A player leaves, or is killed.</summary>
    Leave,

    /// <summary>A player's process stands still from now on.</summary>
    Stop,

    /// <summary>It goes on.</summary>
    GoOn,

    /// <summary>An action is done.</summary>
    Act,

    /// <summary>Nothing more is done.</summary>
    End,
}
