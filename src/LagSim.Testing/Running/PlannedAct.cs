using System;

namespace LagSim.Testing.Running;

/// <summary>Something that a player of a test does.</summary>
/// <param name="AtSeconds">When, in seconds since the start; of what is repeated the first time.</param>
/// <param name="EverySeconds">How far apart the times are; null for what is done once.</param>
/// <param name="Player">Who does it.</param>
/// <param name="Act">What it does.</param>
internal sealed record PlannedAct(double AtSeconds, double? EverySeconds, int Player, Action<TestPlayer> Act);
