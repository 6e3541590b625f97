using AirHockey;

namespace LagSim.Play;

/// <summary>A second puck, or a prize, and where it is seen, in metres.</summary>
/// <param name="Prize">What who takes it gets; null for a puck.</param>
/// <param name="X">Where it is seen.</param>
/// <param name="Y">Where it is seen.</param>
internal readonly record struct AirHockeyThing(PrizeKind? Prize, double X, double Y);
