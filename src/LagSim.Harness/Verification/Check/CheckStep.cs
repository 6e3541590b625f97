namespace LagSim.Harness.Verification.Check;

/// <summary>One scheduled step of a drawn session.</summary>
/// <param name="AtSeconds">The time, from the session's start.</param>
/// <param name="Kind">The kind of step.</param>
/// <param name="Index">The index of the player or action; without meaning at the end.</param>
internal readonly record struct CheckStep(double AtSeconds, CheckStepKind Kind, int Index);
