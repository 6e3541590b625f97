namespace LagSim.Harness.Verification.Check;

/// <summary>A failed session, and the least of it that still fails.</summary>
/// <param name="Whole">The outcome of the whole session.</param>
/// <param name="Least">The outcome of the least that was found to fail; the whole session's if it was not shrunk.</param>
/// <param name="IsShrunk">Whether it was shrunk.</param>
/// <param name="Command">The command that plays the least; if it was not shrunk, the command that plays and shrinks the session.</param>
public sealed record CheckFailure(CheckOutcome Whole, CheckOutcome Least, bool IsShrunk, string Command);
