using System;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Check;

/// <summary>The first event, in canonical order, that a peer has otherwise than the peer that never had a delay.</summary>
/// <param name="Peer">The peer; 0 is the host.</param>
/// <param name="Body">The body it happened to.</param>
/// <param name="SinceStartSeconds">When the earlier of the two versions happens.</param>
/// <param name="ExpectedKey">The event that should be there; null if there should be none.</param>
/// <param name="Expected">The body right after it.</param>
/// <param name="ActualKey">The event that is there; null if there is none.</param>
/// <param name="Actual">The body right after it.</param>
public sealed record FirstDifference(
    int Peer, BodyId Body, double SinceStartSeconds, EventKey? ExpectedKey, BodyState Expected, EventKey? ActualKey, BodyState Actual)
{
    /// <summary>Both versions, in one sentence.</summary>
    public override string ToString() => FormattableString.Invariant(
        $"Peer {Peer}, body {Body}, {SinceStartSeconds:R} s after the start: expected {Text(ExpectedKey, Expected)}; there is {Text(ActualKey, Actual)}.");

    /// <summary>An event and what came of it.</summary>
    public static string Text(EventKey? key, BodyState state) => key is null ? "none" : $"{key} ({state.Motion} at {state.Position} m with {state.Velocity} m/s)";
}
