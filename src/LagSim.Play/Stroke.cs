namespace LagSim.Play;

/// <summary>A body gets a velocity from a player, as a cue gives it to a ball.</summary>
/// <param name="Pane">The number of the player's pane.</param>
/// <param name="Body">The number of the body.</param>
/// <param name="VelocityX">In metres a second of the view.</param>
/// <param name="VelocityY">In metres a second of the view.</param>
internal readonly record struct Stroke(int Pane, int Body, double VelocityX, double VelocityY);
