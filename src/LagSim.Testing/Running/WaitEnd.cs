namespace LagSim.Testing.Running;

/// <summary>Why a wait ended.</summary>
internal enum WaitEnd
{
    /// <summary>The condition holds.</summary>
    Met,

    /// <summary>The timeout passed.</summary>
    TimedOut,

    /// <summary>The condition can no longer come true.</summary>
    Impossible,
}
