using System;
using LagSim.Net.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Clocks;

public class ClockSyncTests
{
    private static readonly SimDuration Ahead = SimDuration.FromSeconds(1.24);

    [Fact]
    public void Add_SymmetricDelays_FindsTheOffsetExactly()
    {
        ClockSync sync = new();

        Assert.True(Exchange(sync, 0, 105, 105));

        Assert.Equal(Ahead, sync.Offset);
        Assert.Equal(Milliseconds(210), sync.RoundTrip);
        Assert.Equal(Milliseconds(105), sync.ErrorBound);
    }

    [Fact]
    public void Add_AsymmetricDelays_IsOffByHalfTheDifferenceAndWithinTheBound()
    {
        ClockSync sync = new();

        Exchange(sync, 0, 10, 200);

        Assert.Equal(Ahead - Milliseconds(95), sync.Offset);
        Assert.Equal(Milliseconds(210), sync.RoundTrip);
        Assert.True(Ahead - sync.Offset <= sync.ErrorBound);
    }

    [Fact]
    public void Add_OtherPeerHoldsTheEcho_DoesNotCountTheWait()
    {
        ClockSync sync = new();

        Exchange(sync, 0, 20, 20, heldMs: 5000);

        Assert.Equal(Ahead, sync.Offset);
        Assert.Equal(Milliseconds(40), sync.RoundTrip);
    }

    [Fact]
    public void Add_JitteryDelays_KeepsTheSampleOfTheShortestRoundTrip()
    {
        ClockSync sync = new();
        Random random = new(5);
        for (int i = 0; i < 40; i++)
        {
            Exchange(sync, i * 50, 30 + random.Next(1, 200), 30 + random.Next(1, 200));
        }

        Exchange(sync, 2000, 30, 30);
        Exchange(sync, 2050, 30, 230);

        Assert.Equal(Milliseconds(60), sync.RoundTrip);
        Assert.Equal(Ahead, sync.Offset);
    }

    [Fact]
    public void Add_BestSampleLeavesTheWindow_IsForgotten()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 1, 1);
        for (int i = 1; i < ClockSync.WindowSamples; i++)
        {
            Exchange(sync, i * 50, 40, 40);
        }

        Assert.Equal(Milliseconds(2), sync.RoundTrip);
        Exchange(sync, 10_000, 40, 40);
        Assert.Equal(Milliseconds(80), sync.RoundTrip);
    }

    [Fact]
    public void Add_EqualRoundTrips_PrefersTheNewest()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 10, 30);

        Exchange(sync, 50, 20, 20);

        Assert.Equal(Ahead, sync.Offset);
    }

    [Fact]
    public void Add_AnyDelays_ErrorStaysWithinTheBound()
    {
        Random random = new(7);
        for (int i = 0; i < 10_000; i++)
        {
            ClockSync sync = new();
            SimDuration away = SimDuration.FromTicks(random.NextInt64(1L << 39));
            SimDuration back = SimDuration.FromTicks(random.NextInt64(1L << 39));
            SimTime sent = SimTime.FromTicks(random.NextInt64(1L << 50));
            sync.Add(sent, sent + away + Ahead, sent + away + Ahead, sent + away + back);
            SimDuration error = sync.Offset - Ahead;
            Assert.True(error <= sync.ErrorBound && -error <= sync.ErrorBound, $"{error} is beyond {sync.ErrorBound}");
        }
    }

    [Fact]
    public void Add_ImpossibleOrAbsurd_IsRefusedAndChangesNothing()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 10, 10);
        SimTime zero = SimTime.Zero, second = SimTime.FromSeconds(1);

        Assert.False(sync.Add(second, zero, zero, zero)); // arrived before it left
        Assert.False(sync.Add(zero, second, zero, second)); // answered before it was asked
        Assert.False(sync.Add(zero, zero, SimTime.FromSeconds(2), second)); // held longer than the whole took
        Assert.False(sync.Add(zero, zero, zero, SimTime.FromSeconds(61)));
        Assert.False(sync.Add(SimTime.MinValue, SimTime.MaxValue, SimTime.MaxValue, SimTime.MaxValue));
        Assert.False(sync.Add(zero, SimTime.MinValue, SimTime.MaxValue, second));

        Assert.Equal(1, sync.SampleCount);
        Assert.Equal(6, sync.RefusedCount);
        Assert.Equal(Ahead, sync.Offset);
    }

    [Fact]
    public void IsReady_AfterThatManySamples_IsTrue()
    {
        ClockSync sync = new(readyAfter: 3);
        for (int i = 0; i < 3; i++)
        {
            Assert.False(sync.IsReady);
            Exchange(sync, i * 50, 10, 10);
        }

        Assert.True(sync.IsReady);
        Assert.Throws<ArgumentOutOfRangeException>(() => new ClockSync(0));
    }

    // A whole number of the rounded millisecond, so that sums are exact.
    private static SimDuration Milliseconds(long count) => SimDuration.FromMilliseconds(1) * count;

    private static bool Exchange(ClockSync sync, long atMs, long outMs, long backMs, long heldMs = 3)
    {
        SimTime sent = SimTime.Zero + Milliseconds(atMs);
        SimTime there = sent + Milliseconds(outMs);
        SimTime answered = there + Milliseconds(heldMs);
        return sync.Add(sent, there + Ahead, answered + Ahead, answered + Milliseconds(backMs));
    }
}
