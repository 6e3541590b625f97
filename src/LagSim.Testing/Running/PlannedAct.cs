using System;

namespace LagSim.Testing.Running;

/// <summary>An action of a player in a test.</summary>
/// <param name="AtSeconds">The time, in seconds since the start; for a repeated action the first time.</param>
/// <param name="EverySeconds">The interval in seconds; null for an action done once.</param>
/// <param name="Player">The player.</param>
/// <param name="Act">The action.</param>
internal sealed record PlannedAct(double AtSeconds, double? EverySeconds, int Player, Action<TestPlayer> Act);
