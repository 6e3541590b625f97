using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Text;
using LagSim.Time;

namespace LagSim.Testing;

/// <summary>The first event, in canonical order, in which a peer differs from the peer that never had a delay.</summary>
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

    /// <summary>The time of that event.</summary>
    public double SinceStartSeconds => (Key.Time - Start).ToSeconds();

    /// <summary>
    /// Describes the difference in one sentence: the body, both versions, and how far apart they are, with times since the start.
    /// </summary>
    /// <remarks>Numbers have four digits if that distinguishes them, otherwise all.</remarks>
    public override string ToString() => Text(body => body.ToString());

    /// <summary>The same sentence, with names for the bodies.</summary>
    internal string Text(Func<BodyId, string> nameOf) => $"Peer {Peer}, body {nameOf(Body)}, {What(nameOf)}.";

    private string What(Func<BodyId, string> nameOf)
    {
        if (ExpectedKey is not EventKey should)
        {
            return $"expected no event here; there is {Event(ActualKey!.Value, nameOf)}, {After(Actual)}";
        }

        if (ActualKey is not EventKey there)
        {
            return $"expected {Event(should, nameOf)}, {After(Expected)}; there is none";
        }

        return should == there
            ? $"after {Event(should, nameOf)}: {States()}"
            : $"{Events(should, there, nameOf)}; right after {(should.Time == there.Time ? "it" : "each")}: {States()}";
    }

    private string Events(in EventKey should, in EventKey there, Func<BodyId, string> nameOf)
    {
        if (should.Time == there.Time)
        {
            string round = should.Round == there.Round ? "" : $", in round {there.Round} of that tick and not {should.Round}";
            return $"expected {Event(should, nameOf)}; there is {Event(there, nameOf)}{round}";
        }

        double apart = (there.Time - should.Time).ToSeconds();
        string when = $"{ShortNumber.Of(Math.Abs(apart))} s {(apart > 0 ? "later" : "earlier")}";
        return $"expected {Event(should, nameOf)}; there is {Event(there, nameOf)}, {when}";
    }

    private string Event(in EventKey key, Func<BodyId, string> nameOf)
    {
        string at = FormattableString.Invariant($"at {(key.Time - Start).ToSeconds():0.############} s"); // to the tick
        return key.Kind switch
        {
            EventKind.Start => $"the start {at}",
            EventKind.StepEnd => $"the end of a step {at}",
            EventKind.Impact when key.Body == key.Other => $"an impact on what does not move {at}",
            EventKind.Impact => $"an impact with body {Others(key, nameOf)} {at}",
            _ => $"{key.Kind} by peer {key.Peer}, its event {key.Sequence}, {at}",
        };
    }

    private string Others(in EventKey key, Func<BodyId, string> nameOf) =>
        key.Body == Body ? nameOf(key.Other) : key.Other == Body ? nameOf(key.Body) : $"{nameOf(key.Body)} and {nameOf(key.Other)}";

    private static string After(BodyState state) => state.Motion == MotionLaw.Absent
        ? "after which it is not there"
        : $"after which it is at {Text(state.Position)} m with {Text(state.Velocity)} m/s, {MotionText.Of(state.Motion)}";

    private string States()
    {
        if (Expected.Motion == MotionLaw.Absent || Actual.Motion == MotionLaw.Absent)
        {
            return $"expected {Presence(Expected)}, there is {Presence(Actual)}";
        }

        List<string> parts = [];
        if (Expected.Motion != Actual.Motion)
        {
            parts.Add($"motion expected {MotionText.Of(Expected.Motion)}, there is {MotionText.Of(Actual.Motion)}");
        }

        Add(parts, "position", Expected.Position, Actual.Position, "m");
        Add(parts, "velocity", Expected.Velocity, Actual.Velocity, "m/s");
        Add(parts, "spin", Expected.Spin, Actual.Spin, "rad/s");
        return parts.Count == 0 ? "the states are the same" : string.Join("; ", parts);
    }

    private static string Presence(BodyState state) =>
        state.Motion == MotionLaw.Absent ? "no body" : $"one at {Text(state.Position)} m with {Text(state.Velocity)} m/s, {MotionText.Of(state.Motion)}";

    private static void Add(List<string> parts, string what, Vector3D should, Vector3D there, string unit)
    {
        if (should != there)
        {
            bool isTold = Text(should) != Text(there);
            parts.Add(
                $"{what} expected {(isTold ? Text(should) : should.ToString())} {unit}, there is {(isTold ? Text(there) : there.ToString())} {unit},"
                + $" {ShortNumber.Of((there - should).Length)} {unit} apart");
        }
    }

    private static string Text(in Vector3D v) => $"({ShortNumber.Of(v.X)}, {ShortNumber.Of(v.Y)}, {ShortNumber.Of(v.Z)})";
}
