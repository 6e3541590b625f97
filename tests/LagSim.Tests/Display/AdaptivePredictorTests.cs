using System;
using System.Linq;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Display;

/// <summary>What the predictor of a hand takes, refuses, remembers and says.</summary>
public sealed class AdaptivePredictorTests
{
    private const int Hold = 0, Velocity = 6;

    [Fact]
    public void TryPredict_NothingHeard_IsFalse()
    {
        AdaptivePredictor predictor = new();
        Assert.False(predictor.HasSamples);
        Assert.False(predictor.TryPredict(At(1), out Vector3D position));
        Assert.Equal(Vector3D.Zero, position);
        Assert.Throws<InvalidOperationException>(() => predictor.NewestSample);
    }

    [Fact]
    public void TryPredict_SteadyHand_IsFollowedAndItsTurnIsLearned()
    {
        AdaptivePredictor predictor = Heard(t => V(2 * t, 1), V(2), 2);
        Assert.True(predictor.TryPredict(At(2.1), out Vector3D position));
        Assert.Equal(4.2, position.X, 0.02);
        Assert.True(predictor.WeightOf(Hold) < 1e-6);
        Assert.Equal(1, Enumerable.Range(0, AdaptivePredictor.Candidates.Count).Sum(predictor.WeightOf), 1e-12);
    }

    [Fact]
    public void WeightOf_ShakenHand_VelocityCountsForNothing()
    {
        // 4 Hz, told 125 ms later: half a turn, so velocity says the opposite of what comes.
        AdaptivePredictor predictor = new();
        for (int n = 0; n <= 240; n++)
        {
            double phase = 2 * Math.PI * 4 * n / 120;
            predictor.TryPredict(At((n / 120.0) + 0.1), out _);
            predictor.Add(At(n / 120.0), V(0.05 * Math.Sin(phase)), V(0.05 * 2 * Math.PI * 4 * Math.Cos(phase)));
        }

        Assert.True(predictor.WeightOf(Velocity) < 1e-6);
    }

    [Fact]
    public void TryPredict_AtOrBeforeTheNewest_IsWhereItWas()
    {
        AdaptivePredictor predictor = new();
        predictor.Add(At(1), V(0), V(9));
        predictor.Add(At(2), V(4), V(9));
        Assert.True(predictor.TryPredict(At(2), out Vector3D newest));
        Assert.Equal(V(4), newest);
        Assert.True(predictor.TryPredict(At(1.25), out Vector3D between));
        Assert.Equal(V(1), between);
        Assert.True(predictor.TryPredict(At(1), Velocity, out Vector3D oldest));
        Assert.Equal(V(0), oldest);
        Assert.False(predictor.TryPredict(At(0.99), out _));
    }

    [Fact]
    public void TryPredict_LongAfterTheNewest_IsWhereItWasTakenToBeAfterASecond()
    {
        AdaptivePredictor predictor = Heard(t => V(t), V(1), 1);
        Assert.True(predictor.TryPredict(At(1) + AdaptivePredictor.MaxHorizon, Velocity, out Vector3D second));
        Assert.Equal(2, second.X, 1e-9);
        Assert.True(predictor.TryPredict(SimTime.MaxValue, Velocity, out Vector3D never));
        Assert.Equal(second, never);
        Assert.True(predictor.TryPredict(SimTime.MaxValue, out Vector3D mixed));
        Assert.True(mixed.IsFinite);
    }

    [Fact]
    public void Add_NotNewer_ChangesNothing()
    {
        AdaptivePredictor predictor = new();
        Assert.True(predictor.Add(At(1), V(1), V(0)));
        Assert.False(predictor.Add(At(1), V(2), V(0)));
        Assert.False(predictor.Add(At(0.5), V(3), V(0)));
        Assert.Equal(At(1), predictor.NewestSample);
        Assert.True(predictor.TryPredict(At(1), out Vector3D position));
        Assert.Equal(V(1), position);
    }

    [Fact]
    public void Add_NotFinite_IsRefusedByName()
    {
        AdaptivePredictor predictor = new();
        Assert.Equal("position", Assert.Throws<ArgumentOutOfRangeException>(() => predictor.Add(At(1), V(double.NaN), V(0))).ParamName);
        Assert.Equal("velocity", Assert.Throws<ArgumentOutOfRangeException>(() => predictor.Add(At(1), V(0), V(double.PositiveInfinity))).ParamName);
        Assert.False(predictor.HasSamples);
        Assert.Throws<ArgumentOutOfRangeException>(() => predictor.WeightOf(8));
        Assert.Throws<ArgumentOutOfRangeException>(() => predictor.TryPredict(At(1), -1, out _));
    }

    [Fact]
    public void TryPredict_AtBothEndsOfTime_Answers()
    {
        AdaptivePredictor predictor = new();
        Assert.True(predictor.Add(SimTime.MinValue, V(1), V(1)));
        Assert.True(predictor.TryPredict(SimTime.MaxValue, out _));
        Assert.True(predictor.Add(SimTime.MinValue + SimDuration.OneTick, V(1), V(1)));
        Assert.True(predictor.Add(SimTime.MaxValue, V(2), V(1)));
        Assert.True(predictor.TryPredict(SimTime.MaxValue, out Vector3D last));
        Assert.Equal(V(2), last);
    }

    [Fact]
    public void ErrorLowerBound_TwoHandsThatPart_NoPredictorDoesBetterForBothAndHoldingAttainsIt()
    {
        // Until 2 s the hand rests; then it may go either way with 10 m/s^2. Nobody can tell which 100 ms after the last sample.
        double least = AdaptivePredictor.ErrorLowerBound(10, SimDuration.FromSeconds(0.1));
        Assert.Equal(0.05, least, 1e-12);
        AdaptivePredictor predictor = Heard(_ => V(0), V(0), 2);
        predictor.TryPredict(At(2.1), out Vector3D told);
        double worst = Math.Max((told - V(least)).Length, (told - V(-least)).Length);
        Assert.InRange(worst, least, 1.0001 * least);
        Assert.True((told - V(least)).Length < 2 * least); // A L^2, the control, would be too much to claim
        Assert.Throws<ArgumentOutOfRangeException>(() => AdaptivePredictor.ErrorLowerBound(-1, SimDuration.Zero));
        Assert.Throws<ArgumentOutOfRangeException>(() => AdaptivePredictor.ErrorLowerBound(double.PositiveInfinity, SimDuration.Zero));
        Assert.Throws<ArgumentOutOfRangeException>(() => AdaptivePredictor.ErrorLowerBound(1, -SimDuration.OneTick));
    }

    [Fact]
    public void AddAndTryPredict_AfterConstruction_AllocateNothing()
    {
        // The least of a few: a collection that another test causes gives this thread's allocation buffer back, which counts as allocated.
        Assert.Equal(0, Enumerable.Range(0, 5).Min(_ => Allocated(new object[0])));
        Assert.True(Allocated(null) > 0);
    }

    /// <summary>Bytes of a minute of samples and frames over a span that changes, so that all is learned anew now and then; null allocates besides, as the control.</summary>
    private static long Allocated(object[]? nothing)
    {
        AdaptivePredictor predictor = new();
        predictor.Add(At(0), V(0), V(0));
        predictor.TryPredict(At(0.1), out _);
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int n = 1; n < 7200; n++)
        {
            double time = n / 120.0;
            predictor.Add(At(time), V(Math.Sin(time)), V(Math.Cos(time)));
            predictor.TryPredict(At(time + (n < 3600 ? 0.1 : 0.3)), out _);
            _ = nothing ?? new object[1];
        }

        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    private static AdaptivePredictor Heard(Func<double, Vector3D> position, Vector3D velocity, double until)
    {
        AdaptivePredictor predictor = new();
        for (int n = 0; n <= until * 120; n++)
        {
            predictor.TryPredict(At((n / 120.0) + 0.1), out _);
            predictor.Add(At(n / 120.0), position(n / 120.0), velocity);
        }

        return predictor;
    }
}
