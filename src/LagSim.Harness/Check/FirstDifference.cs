using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Check;

/// <summary>The first event, in canonical order, that a peer has otherwise than the peer that never had a delay.</summary>
/// <param name="Peer">The peer; 0 is the host.</param>
/// <param name="Body">The body it happened to.</param>
/// <param name="Start">When the world began.</param>
/// <param name="ExpectedKey">The event that should be there; null if there should be none.</param>
/// <param name="Expected">The body right after it.</param>
/// <param name="ActualKey">The event that is there; null if there is none.</param>
/// <param name="Actual">The body right after it.</param>
public sealed record FirstDifference(
    int Peer, BodyId Body, SimTime Start, EventKey? ExpectedKey, BodyState Expected, EventKey? ActualKey, BodyState Actual)
{
    /// <summary>The earlier of the two versions.</summary>
    public EventKey Key => ExpectedKey is EventKey should && ActualKey is EventKey there ? (should < there ? should : there) : (ExpectedKey ?? ActualKey)!.Value;

    /// <summary>When that happens.</summary>
    public double SinceStartSeconds => (Key.Time - Start).ToSeconds();

    /// <summary>Both versions, in one sentence.</summary>
    public override string ToString() => FormattableString.Invariant(
        $"Peer {Peer}, body {Body}, seconds after the start: expected {Text(ExpectedKey, Expected)}; there is {Text(ActualKey, Actual)}.");

    private string Text(EventKey? version, BodyState state) => version is not EventKey key ? "none" : FormattableString.Invariant(
        $"at {(key.Time - Start).ToSeconds():R} round {key.Round} {key.Kind} {key.Body}/{key.Other} by {key.Peer}.{key.Sequence} ({state.Motion} at {state.Position} m with {state.Velocity} m/s)");
}
