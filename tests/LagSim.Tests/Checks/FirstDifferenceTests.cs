using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Checks;

/// <summary>The first difference of a check as a sentence that a person reads.</summary>
public sealed class FirstDifferenceTests
{
    private static readonly EventKey Meeting = new(At(2.5), 0, EventKind.Impact, First, Second, 0, 0);

    [Fact]
    public void ToString_SameEventOtherStates_NamesOnlyWhatDiffersAndHowFarApart() => Assert.Equal(
        "Peer 1, body 0.0.0, after an impact with body 0.0.1 at 1.5 s: velocity expected (1, 0, 0) m/s, there is (1, 0.25, 0) m/s, 0.25 m/s apart.",
        Of(Meeting, Flying(V(1)), Meeting, Flying(V(1, 0.25))).ToString());

    [Fact]
    public void ToString_LastBit_ShowsAllDigits()
    {
        string text = Of(Meeting, Flying(V(1)), Meeting, Flying(V(Math.BitIncrement(1.0)))).ToString();
        Assert.Contains("velocity expected (1, 0, 0) m/s, there is (1.0000000000000002, 0, 0) m/s, 2.22e-16 m/s apart", text, StringComparison.Ordinal);
        Assert.DoesNotContain("position", text, StringComparison.Ordinal);
    }

    [Fact]
    public void ToString_OtherEvent_NamesBothAndHowMuchLater()
    {
        EventKey floor = new(At(2.75), 0, EventKind.Impact, First, First, 0, 0);
        Assert.StartsWith(
            "Peer 1, body 0.0.0, expected an impact with body 0.0.1 at 1.5 s; there is an impact on what does not move at 1.75 s, 0.25 s later; right after each: motion expected",
            Of(Meeting, Flying(V(1)), floor, new BodyState(V(2), V(1), MotionLaw.Sliding)).ToString(), StringComparison.Ordinal);
        EventKey second = new(At(2.5), 1, EventKind.Impact, First, Second, 0, 0);
        Assert.Contains("in round 1 of that tick and not 0; right after it: the states are the same", Of(Meeting, Flying(V(1)), second, Flying(V(1))).ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void ToString_EventThatIsMissingOrTooMuch_SaysWhich()
    {
        EventKey impulse = new(At(2.5), 0, EventKind.Impulse, First, First, 2, 7);
        Assert.Equal(
            "Peer 1, body 0.0.0, expected Impulse by peer 2, its event 7, at 1.5 s, after which it is at (2, 0, 0) m with (1, 0, 0) m/s, ballistic; there is none.",
            Of(impulse, Flying(V(1)), null, default).ToString());
        Assert.StartsWith(
            "Peer 1, body 0.0.0, expected no event here; there is Impulse",
            Of(null, default, impulse, Flying(V(1))).ToString(),
            StringComparison.Ordinal);
        Assert.Contains(
            "expected no body, there is one at (2, 0, 0) m",
            Of(impulse, default, impulse, Flying(V(1))).ToString(),
            StringComparison.Ordinal);
    }

    private static BodyState Flying(Vector3D velocity) => new(V(2), velocity, MotionLaw.Ballistic);

    private static FirstDifference Of(EventKey? should, BodyState expected, EventKey? there, BodyState actual) =>
        new(1, First, At(1), should, expected, there, actual);
}
