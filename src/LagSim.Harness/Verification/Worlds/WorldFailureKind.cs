namespace LagSim.Harness.Verification.Worlds;

/// <summary>How a world failed.</summary>
public enum WorldFailureKind
{
    /// <summary>It did not.</summary>
    None,

    /// <summary>Something threw: acts that any player may do ended the world.</summary>
    Ended,

    /// <summary>What heard of events late, or began in the middle, has other bits, or answered otherwise.</summary>
    Differs,

    /// <summary>A promise about its physics was broken.</summary>
    Promise,
}
