namespace LagSim.Testing.Running;

/// <summary>How a wait for something ended.</summary>
internal enum WaitEnd
{
    /// <summary>It came about.</summary>
    IsSo,

    /// <summary>It did not in the time that there was.</summary>
    TimeIsUp,

    /// <summary>It cannot any more.</summary>
    InVain,
}
