namespace LagSim.Harness.Verification.Hard;

/// <summary>The scale of the hard cases.</summary>
public enum HardScale
{
    /// <summary>Takes some seconds for all cases: what tests run.</summary>
    Small = 0,

    /// <summary>The sizes in the catalogue: takes some minutes for all cases.</summary>
    Full = 1,
}
