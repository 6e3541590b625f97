namespace LagSim.Harness.Verification.Hard;

/// <summary>One thing that was checked: how far off it was, how far it may be, and who says so. Immutable.</summary>
/// <param name="Case">The hard case it belongs to.</param>
/// <param name="Size">At which size, in words: how many contacts, which step, which ratio.</param>
/// <param name="Error">How far off; NaN where nothing came out, which fails.</param>
/// <param name="ErrorKind">What the error is, with its unit after an underscore: <c>time_s</c>, <c>energy_relative</c>,
/// <c>count</c>.</param>
/// <param name="Bound">The most it may be, in the same unit.</param>
/// <param name="Argument">Why the bound is what it is: from rounding, ticks, or the order of a method. Never from what came out.</param>
/// <param name="Reference">What the result is held against.</param>
public sealed record HardRow(string Case, string Size, double Error, string ErrorKind, double Bound, string Argument, string Reference)
{
    /// <summary>What else there is to say, such as the statistical error or an exception's sentence.</summary>
    public string Note { get; init; } = "";

    /// <summary>Whether the engine is able to do this at all; what it is not able to do has not passed.</summary>
    public bool IsModelled { get; init; } = true;

    /// <summary>Whether the error is within its bound.</summary>
    public bool Passed => IsModelled && Error <= Bound;
}
