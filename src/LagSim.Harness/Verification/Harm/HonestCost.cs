namespace LagSim.Harness.Verification.Harm;

/// <summary>What honest players of a scene cost.</summary>
/// <param name="Scene">The scene.</param>
/// <param name="Players">How many play.</param>
/// <param name="WorkPerSecond">What the costliest of them costs a second, in units of about a microsecond.</param>
/// <param name="PeakWork">The most that one of them used up of his budget at a time, in the same units.</param>
/// <param name="Part">That as a part of the budget.</param>
/// <param name="Events">How much they did.</param>
/// <param name="Expelled">How many were sent away.</param>
public sealed record HonestCost(string Scene, int Players, double WorkPerSecond, double PeakWork, double Part, long Events, int Expelled);
