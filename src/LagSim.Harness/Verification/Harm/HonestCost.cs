namespace LagSim.Harness.Verification.Harm;

/// <summary>The cost of honest players in one scene.</summary>
/// <param name="Scene">The scene.</param>
/// <param name="Players">The number of players.</param>
/// <param name="WorkPerSecond">The work of the costliest player, in units of about a microsecond per second.</param>
/// <param name="PeakWork">The largest amount of its budget that a player used, in the same units.</param>
/// <param name="Part"><paramref name="PeakWork"/> as a fraction of the budget.</param>
/// <param name="Events">The number of their events.</param>
/// <param name="Expelled">The number of players that were disconnected.</param>
public sealed record HonestCost(string Scene, int Players, double WorkPerSecond, double PeakWork, double Part, long Events, int Expelled);
