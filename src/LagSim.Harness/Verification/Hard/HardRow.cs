namespace LagSim.Harness.Verification.Hard;

/// <summary>One result of a check: the error, its bound, and the reference. Immutable.</summary>
/// <param name="Case">The hard case it belongs to.</param>
/// <param name="Size">The size, in words: the number of contacts, the step, or the ratio.</param>
/// <param name="Error">The error; NaN if there was no result, which fails.</param>
/// <param name="ErrorKind">The kind of error, with its unit after an underscore: <c>time_s</c>, <c>energy_relative</c>,
/// <c>count</c>.</param>
/// <param name="Bound">The bound of the error, in the same unit.</param>
/// <param name="Argument">The derivation of the bound: from rounding, ticks, or the order of a method, never from a result.</param>
/// <param name="Reference">The reference of the result.</param>
public sealed record HardRow(string Case, string Size, double Error, string ErrorKind, double Bound, string Argument, string Reference)
{
    /// <summary>A note, such as the statistical error or an exception's message.</summary>
    public string Note { get; init; } = "";

    /// <summary>Whether the engine supports this at all; an unsupported check has not passed.</summary>
    public bool IsModelled { get; init; } = true;

    /// <summary>Whether the error is within its bound.</summary>
    public bool Passed => IsModelled && Error <= Bound;
}
