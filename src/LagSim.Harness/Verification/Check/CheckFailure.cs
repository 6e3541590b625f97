namespace LagSim.Harness.Verification.Check;

/// <summary>A session that failed, and the least of it that still does.</summary>
/// <param name="Whole">What the whole session came to.</param>
/// <param name="Least">The least that was found to fail; the whole again where that was not looked for.</param>
/// <param name="IsShrunk">Whether that was looked for.</param>
/// <param name="Command">The command that plays just that; where it was not looked for, the one that plays the session and looks for
/// it.</param>
public sealed record CheckFailure(CheckOutcome Whole, CheckOutcome Least, bool IsShrunk, string Command);
