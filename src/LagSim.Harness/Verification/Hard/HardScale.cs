namespace LagSim.Harness.Verification.Hard;

/// <summary>How large the sizes of the hard cases are.</summary>
public enum HardScale
{
    /// <summary>Some seconds for all of them: what tests run.</summary>
    Small = 0,

    /// <summary>The sizes that the catalogue names: some minutes for all of them.</summary>
    Full = 1,
}
