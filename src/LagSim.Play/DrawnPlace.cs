namespace LagSim.Play;

/// <summary>Where a body is drawn in a pane, and where it is in truth, in metres of the view.</summary>
/// <param name="IsThere">Whether it is in that world.</param>
/// <param name="Drawn">Where it is drawn.</param>
/// <param name="Real">Where it is in the world without delay.</param>
/// <param name="Glow">How lately its path was rewritten: 1 just now, 0 not lately.</param>
/// <param name="IsInHand">Whether it is drawn in the hand of the person at this pane.</param>
internal readonly record struct DrawnPlace(bool IsThere, (double X, double Y) Drawn, (double X, double Y) Real, double Glow, bool IsInHand);
