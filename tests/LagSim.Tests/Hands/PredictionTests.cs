using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Hands;

/// <summary>What the predictor of a hand promises, held on seeds that it was not tuned on (those were 1001 to 1004).</summary>
public sealed class PredictionTests(ITestOutputHelper output)
{
    private const double Promise = 1.15;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Adaptive_GeneratedMotions_StaysWithinItsPromiseOfTheBestInHindsight(ulong seed)
    {
        foreach (PredictionError error in Both(seed, 25, 50, 100, 200, 300, 500))
        {
            Assert.InRange(error.RatioToBest, 0, Promise);
        }
    }

    [Fact]
    public void WithoutAdaptation_OneOfTheMotions_BreaksThePromise()
    {
        // The control: whatever is taken once and for all, of those that do not learn, or the mean of all.
        PredictionError[] both = Both(1, 100);
        int learning = AdaptivePredictor.Candidates.ToList().IndexOf("least squares");
        for (int candidate = 0; candidate < learning; candidate++)
        {
            Assert.True(both.Max(e => e.CandidateMetres[candidate] / e.BestInHindsightMetres) > Promise, AdaptivePredictor.Candidates[candidate]);
        }

        Assert.True(HandMotions.Names.Zip(both).Max(of => MeanOfAll(HandMotions.Generate(of.First, 1), 12) / of.Second.BestInHindsightMetres) > Promise);
    }

    [Theory]
    [InlineData(HandMotions.Slow)]
    [InlineData(HandMotions.Random)]
    public void Adaptive_UnevenSamplesAndFramesOverALinkThatChanges_StaysWithinItsPromise(string name)
    {
        // A sample every 16 to 50 ms, delayed by 60 to 90 ms and after half a minute by 160 to 200 ms; frames of 60 Hz.
        HandMotion motion = HandMotions.Generate(name, 4);
        SeededRandom luck = new(9);
        Queue<(double Arrives, int Sample)> travelling = new();
        AdaptivePredictor predictor = new();
        double next = 0, adaptive = 0;
        double[] alone = new double[AdaptivePredictor.Candidates.Count];
        for (int n = 0; n < motion.Count; n += 2)
        {
            double now = n / 120.0;
            if (now >= next)
            {
                next = now + luck.NextDouble(0.016, 0.05);
                travelling.Enqueue((now + (now < 30 ? luck.NextDouble(0.06, 0.09) : luck.NextDouble(0.16, 0.2)), n));
            }

            while (travelling.Count > 0 && travelling.Peek().Arrives <= now)
            {
                int sample = travelling.Dequeue().Sample;
                predictor.Add(At(sample / 120.0), motion.PositionAt(sample), motion.VelocityAt(sample));
            }

            if (predictor.TryPredict(At(now), out Vector3D told) && now > 1)
            {
                adaptive += (told - motion.PositionAt(n)).LengthSquared;
                for (int candidate = 0; candidate < alone.Length; candidate++)
                {
                    predictor.TryPredict(At(now), candidate, out Vector3D other);
                    alone[candidate] += (other - motion.PositionAt(n)).LengthSquared;
                }
            }
        }

        output.WriteLine($"{name}: {Math.Sqrt(adaptive / alone.Min()):0.000} of {AdaptivePredictor.Candidates[Array.IndexOf(alone, alone.Min())]}");
        Assert.InRange(Math.Sqrt(adaptive / alone.Min()), 0, Promise);
        Assert.True(Math.Sqrt(alone.Max() / alone.Min()) > Promise);
    }

    [Theory]
    [InlineData(HandMotions.Slow)]
    [InlineData(HandMotions.Random)]
    public void LinearFit_InSample_IsBelowEveryLinearPredictorAndBelowItsCrossValidation(string name)
    {
        foreach (double horizon in new double[] { 25, 100, 500 })
        {
            PredictionError error = PredictionTest.Run(HandMotions.Generate(name, 1), horizon);
            Assert.All(error.CandidateMetres.Take(7), linear => Assert.True(error.LinearInSampleMetres < linear));
            Assert.True(error.LinearInSampleMetres <= error.LinearMetres);
            Assert.InRange(error.LinearMetres / error.LinearInSampleMetres, 1, 1.1); // 57 taps for 7,000 samples fit little that is not there
        }
    }

    [Fact]
    public void LinearFit_OfWhatIsLinear_IsExactAndOfNoiseIsNot()
    {
        // Any cubic follows from its last four values; nothing tells the next of independent draws.
        HandMotion cubic = new("cubic", Enumerable.Range(0, 600).Select(n => n / 120.0).Select(t => new Vector3D(t * t * t, 1 - t, t * t)).ToArray());
        LinearFit exact = LinearFit.Of(cubic, 12);
        Assert.InRange(exact.CrossValidatedMetres, 0, 1e-4);
        SeededRandom luck = new(1);
        HandMotion noise = new("noise", Enumerable.Range(0, 6000).Select(_ => new Vector3D(luck.NextGaussian(), 0, 0)).ToArray());
        Assert.InRange(LinearFit.Of(noise, 12).CrossValidatedMetres, 1, 1.1); // the mean of the taps is off by 1 / sqrt 20
    }

    [Fact]
    public void LinearFit_ShortMotionOfNoise_CrossValidationTellsWhatFittingHides()
    {
        // The control of cross-validation: with few samples the taps fit the noise itself.
        SeededRandom luck = new(2);
        HandMotion noise = new("noise", Enumerable.Range(0, 240).Select(_ => new Vector3D(luck.NextGaussian(), 0, 0)).ToArray());
        LinearFit fit = LinearFit.Of(noise, 12);
        Assert.True(fit.CrossValidatedMetres > 1.1 * fit.InSampleMetres, $"{fit.CrossValidatedMetres} {fit.InSampleMetres}");
    }

    [Fact]
    public void Run_HorizonZero_NobodyErrs()
    {
        PredictionError error = PredictionTest.Run(HandMotions.Generate(HandMotions.Slow, 1), 0);
        Assert.All(error.CandidateMetres.Append(error.AdaptiveMetres).Append(error.LinearMetres).Append(error.LowerBoundMetres), metres => Assert.Equal(0, metres));
        Assert.True(double.IsNaN(error.RatioToBest));
    }

    [Theory]
    [InlineData(-25)]
    [InlineData(30)]
    [InlineData(1025)]
    [InlineData(double.NaN)]
    public void Run_HorizonThatIsNone_IsRefused(double horizon) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => PredictionTest.Run(HandMotions.Generate(HandMotions.Slow, 1), horizon));

    [Fact]
    public void Run_MotionShorterThanTheHorizonAndASecond_IsRefused() => Assert.Throws<ArgumentOutOfRangeException>(
        () => PredictionTest.Run(new HandMotion("short", Enumerable.Repeat(Vector3D.Zero, 150).ToArray()), 500));

    private PredictionError[] Both(ulong seed, params double[] horizons) => HandMotions.Names
        .SelectMany(name => horizons.Select(horizon =>
        {
            PredictionError error = PredictionTest.Run(HandMotions.Generate(name, seed), horizon);
            string best = AdaptivePredictor.Candidates[error.BestCandidate];
            output.WriteLine($"{name} {seed} {horizon} ms: {error.AdaptiveMetres * 1000:0.00} mm, {error.RatioToBest:0.000} of {best}, linear {error.LinearMetres * 1000:0.00} mm");
            return error;
        })).ToArray();

    private static double MeanOfAll(HandMotion motion, int steps)
    {
        AdaptivePredictor predictor = new();
        double sum = 0;
        for (int n = 0; n < motion.Count - steps; n++)
        {
            predictor.Add(At(n / 120.0), motion.PositionAt(n), motion.VelocityAt(n));
            Vector3D mean = default;
            for (int candidate = 0; candidate < AdaptivePredictor.Candidates.Count; candidate++)
            {
                predictor.TryPredict(At((n + steps) / 120.0), candidate, out Vector3D told);
                mean += told / AdaptivePredictor.Candidates.Count;
            }

            sum += (mean - motion.PositionAt(n + steps)).LengthSquared;
        }

        return Math.Sqrt(sum / (motion.Count - steps));
    }

    private static SimTime At(double seconds) => SimTime.FromSeconds(seconds);
}
