using System;
using System.Linq;
using LagSim.Net.Clocks;
using LagSim.Testing.Links;
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

        Near(Ahead, sync.Estimate.Offset);
        Near(Milliseconds(210), sync.RoundTrip);
        AssertBound(105, 0.210 + 0.003, sync);
    }

    [Fact]
    public void Add_AsymmetricDelays_IsOffByHalfTheDifferenceAndWithinTheBound()
    {
        ClockSync sync = new();

        Exchange(sync, 0, 10, 200);

        Near(Ahead - Milliseconds(95), sync.Estimate.Offset);
        Near(Milliseconds(210), sync.RoundTrip);
        Assert.True(Ahead - sync.Estimate.Offset <= sync.Estimate.ErrorBound);
    }

    [Fact]
    public void Add_OtherPeerHoldsTheEcho_DoesNotCountTheWait()
    {
        ClockSync sync = new();

        Exchange(sync, 0, 20, 20, heldMs: 5000);

        Near(Ahead, sync.Estimate.Offset);
        Near(Milliseconds(40), sync.RoundTrip);
        AssertBound(20, 5.040, sync);
    }

    [Theory]
    [InlineData(100)]
    [InlineData(-100)]
    public void Add_OtherPeerHoldsTheEchoWhileClocksDrift_IsNotRefusedAsNegative(double partsPerMillion)
    {
        // Of a round trip of 100 microseconds, 2 s of waiting by another clock leave -100 or 300.
        ClockSync sync = new();
        SkewedClock other = new(new VirtualClock(), partsPerMillion, Ahead);
        for (int i = 0; i < 30; i++)
        {
            SimTime sent = SimTime.FromSeconds(i * 2.1), there = sent + (Milliseconds(1) / 20), answered = there + SimDuration.FromSeconds(2);
            SimTime back = answered + (Milliseconds(1) / 20);
            Assert.True(sync.Add(sent, other.ReadingAt(there), other.ReadingAt(answered), back));
            AssertNear(other.ReadingAt(back) - back, sync.Estimate.Offset, i < 3 ? 0.11 : 0.005);
        }

        Assert.Equal(0, sync.RestartCount);
        AssertNear(Milliseconds(1) / 10, sync.RoundTrip, 0.005);
        Assert.Equal(partsPerMillion, sync.Estimate.DriftPartsPerMillion, 0.5);
    }

    [Fact]
    public void Add_JitteryDelays_KeepsTheSampleOfTheShortestRoundTrip()
    {
        ClockSync sync = new();
        Random random = new(5);
        for (int i = 0; i < 40; i++)
        {
            Exchange(sync, i * 50, 60 + random.Next(1, 200), 60 + random.Next(1, 200));
        }

        Exchange(sync, 2000, 30, 30);
        Exchange(sync, 2050, 30, 230);

        Near(Milliseconds(60), sync.RoundTrip);
        Near(Ahead, sync.Estimate.Offset);
    }

    [Fact]
    public void Add_BestSampleLeavesTheWindow_IsForgotten()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 1, 1);
        for (int i = 1; i < 60; i++)
        {
            Exchange(sync, i * 1000, 40, 40);
        }

        Near(Milliseconds(2), sync.RoundTrip);
        Exchange(sync, 60_000, 40, 40);
        Near(Milliseconds(80), sync.RoundTrip);
    }

    [Fact]
    public void Add_ManyInASecond_CrowdOutNothing()
    {
        // A window by number would have lost the best long before.
        ClockSync sync = new();
        Exchange(sync, 0, 1, 1);
        for (int i = 1; i < 10_000; i++)
        {
            Exchange(sync, i * 5, 40, 40);
        }

        Near(Milliseconds(2), sync.RoundTrip);
        Assert.Equal(10_000, sync.SampleCount);
    }

    [Fact]
    public void Add_AfterALongSilence_TheNewestCountsAlone()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 1, 1);
        Exchange(sync, 1_000_000, 40, 40);

        Near(Milliseconds(80), sync.RoundTrip);
        Near(Ahead, sync.Estimate.Offset);
    }

    [Fact]
    public void Add_OwnClockWentBack_ForgetsWhatWasBefore()
    {
        // By less than a round trip, so that nothing else contradicts.
        ClockSync sync = new();
        Exchange(sync, 5000, 50, 50);
        Exchange(sync, 4900, 60, 60);

        Assert.Equal(1, sync.RestartCount);
        Near(Milliseconds(120), sync.RoundTrip);
    }

    [Fact]
    public void Add_EqualRoundTripsInASecond_PrefersTheNewest()
    {
        ClockSync sync = new();
        Exchange(sync, 0, 10, 30);

        Exchange(sync, 50, 20, 20);

        Near(Ahead, sync.Estimate.Offset);
    }

    [Fact]
    public void Add_ALateAnswerAndALateRequest_BothLimitsCount()
    {
        // Neither round trip is short, but one says precisely how little the offset is, the other how much.
        ClockSync sync = new();
        Exchange(sync, 0, 1, 400);
        Exchange(sync, 1000, 400, 1);

        AssertNear(Ahead, sync.Estimate.Offset, 0.2);
        Assert.InRange(sync.Estimate.ErrorBound.ToMilliseconds(), 1, 2);
    }

    [Fact]
    public void Add_TenThousandAfterWarmUp_AllocatesNothing()
    {
        // The least of a few: a collection that another test causes gives this thread's allocation buffer back, which counts as allocated.
        Assert.Equal(0, Enumerable.Range(0, 5).Min(_ => Measure(0)));
        Assert.True(Measure(24) > 10_000 * 24); // negative control: what does allocate is seen

        static long Measure(int extra)
        {
            ClockSync sync = new();
            SharedClock shared = new(new ManualClock());
            long before = 0;
            for (int i = 0; i < 12_000; i++)
            {
                before = i == 2000 ? GC.GetAllocatedBytesForCurrentThread() : before; // until then code is compiled
                Exchange(sync, i * 50, 20 + (i % 7), 20 + (i % 5));
                shared.Adjust(sync.Estimate);
                GC.KeepAlive(extra > 0 ? new byte[extra] : null);
            }

            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
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
            SimDuration error = sync.Estimate.Offset - Ahead;
            Assert.True(error <= sync.Estimate.ErrorBound && -error <= sync.Estimate.ErrorBound, $"{error} is beyond {sync.Estimate.ErrorBound}");
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
        Assert.Equal(0, sync.RestartCount);
        Near(Ahead, sync.Estimate.Offset);
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

    private static void Near(SimDuration expected, SimDuration actual) => AssertNear(expected, actual, 1e-6);

    private static void AssertNear(SimDuration expected, SimDuration actual, double milliseconds) =>
        Assert.InRange((actual - expected).ToMilliseconds(), -milliseconds, milliseconds);

    /// <summary>Half the round trip, a microsecond of reading, and what the most drift can have done since the request left, nothing of it known to be on either side.</summary>
    private static void AssertBound(double halfRoundTripMs, double seconds, ClockSync sync) =>
        Assert.Equal(halfRoundTripMs + 0.001 + (seconds * ClockEstimate.MaxDrift * 1e-3), sync.Estimate.ErrorBound.ToMilliseconds(), 1e-6);

    private static bool Exchange(ClockSync sync, long atMs, long outMs, long backMs, long heldMs = 3)
    {
        SimTime sent = SimTime.Zero + Milliseconds(atMs);
        SimTime there = sent + Milliseconds(outMs);
        SimTime answered = there + Milliseconds(heldMs);
        return sync.Add(sent, there + Ahead, answered + Ahead, answered + Milliseconds(backMs));
    }
}
