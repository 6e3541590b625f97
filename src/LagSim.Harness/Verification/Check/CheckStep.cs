namespace LagSim.Harness.Verification.Check;

/// <summary>Something that is to happen in a drawn session.</summary>
/// <param name="AtSeconds">When, from the session's start on.</param>
/// <param name="Kind">What.</param>
/// <param name="Index">To which player, or which action; at the end without meaning.</param>
internal readonly record struct CheckStep(double AtSeconds, CheckStepKind Kind, int Index);
