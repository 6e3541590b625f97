namespace LagSim.Testing.Running;

/// <summary>Why a wait ended.</summary>
internal enum WaitEnd
{
    /// <summary>The condition holds.</summary>
    IsSo,

    /// <summary>The timeout passed.</summary>
    TimeIsUp,

    /// <summary>The condition can no longer come true.</summary>
    InVain,
}
