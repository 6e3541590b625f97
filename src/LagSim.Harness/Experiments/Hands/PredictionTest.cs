using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>
/// Measures how well a hand can be predicted from past samples: at every sample of a motion, each predictor estimates the position a
/// horizon later.
/// </summary>
public static class PredictionTest
{
    /// <summary>
    /// The reported horizons, in milliseconds: whole sample intervals from 0 to 500 ms, for which the shortest recorded motion is long
    /// enough.
    /// </summary>
    public static IReadOnlyList<double> DefaultHorizonsMilliseconds { get; } = [0, 25, 50, 75, 100, 150, 200, 250, 300, 400, 500];

    internal static int VelocityCandidate { get; } = AdaptivePredictor.Candidates.ToList().IndexOf("velocity");

    /// <summary>Runs the test at one horizon.</summary>
    /// <param name="motion">The motion.</param>
    /// <param name="horizonMilliseconds">0 to 1000 and a whole number of sample intervals (25/3 ms); the motion must be longer by a
    /// second.</param>
    /// <exception cref="ArgumentOutOfRangeException">The horizon is none of those.</exception>
    public static PredictionError Run(HandMotion motion, double horizonMilliseconds)
    {
        ArgumentNullException.ThrowIfNull(motion);
        int steps = StepsOf(horizonMilliseconds);
        if (!(horizonMilliseconds >= 0 && horizonMilliseconds <= 1000) || Math.Abs((steps * 1000.0 / HandMotion.RateHertz) - horizonMilliseconds) > 1e-6
            || motion.Count < steps + HandMotion.RateHertz)
        {
            throw new ArgumentOutOfRangeException(
                nameof(horizonMilliseconds),
                horizonMilliseconds,
                $"The horizon must be 0 to 1000 ms, a whole number of intervals of 1/{HandMotion.RateHertz} s, and a second shorter than the motion,"
                    + $" {motion.Seconds} s.");
        }

        int first = LinearFit.Taps - 1; // the first sample at which the linear predictor has all its inputs; the same for all predictors
        int count = motion.Count - steps - first;
        double adaptive = 0;
        double[] candidates = new double[AdaptivePredictor.Candidates.Count];
        AdaptivePredictor predictor = new();
        SimDuration horizon = SimDuration.FromSeconds(steps / (double)HandMotion.RateHertz);
        for (int n = 0; n < motion.Count - steps; n++)
        {
            SimTime time = SimTime.FromSeconds(n / (double)HandMotion.RateHertz);
            predictor.Add(time, motion.PositionAt(n), motion.VelocityAt(n));
            Vector3D truth = motion.PositionAt(n + steps);
            predictor.TryPredict(time + horizon, out Vector3D told);
            if (n < first)
            {
                continue;
            }

            adaptive += (told - truth).LengthSquared;
            for (int candidate = 0; candidate < candidates.Length; candidate++)
            {
                predictor.TryPredict(time + horizon, candidate, out Vector3D alone);
                candidates[candidate] += (alone - truth).LengthSquared;
            }
        }

        LinearFit linear = LinearFit.Of(motion, steps);
        return new PredictionError(
            horizonMilliseconds, count, Math.Sqrt(adaptive / count), candidates.Select(sum => Math.Sqrt(sum / count)).ToArray(),
            linear.CrossValidatedMetres, linear.InSampleMetres, AdaptivePredictor.ErrorLowerBound(motion.LargestAcceleration(), horizon));
    }

    private static int StepsOf(double horizonMilliseconds) => (int)Math.Round(horizonMilliseconds * HandMotion.RateHertz / 1000);
}
