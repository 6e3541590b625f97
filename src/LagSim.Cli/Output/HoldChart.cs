using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Charts;
using LagSim.Harness.Hands;
using LagSim.Scenes;

namespace LagSim.Cli.Output;

/// <summary>The pictures of a hand: the error of each prediction against the delay, and the motion itself.</summary>
internal static class HoldChart
{
    private const double ErrorFloor = 1e-4;

    internal static LineChart OfErrors(HandMotion motion, IReadOnlyList<PredictionError> errors)
    {
        double[] delays = errors.Select(error => error.HorizonMilliseconds).ToArray();
        ChartSeries Series(string name, Func<PredictionError, double> of, SeriesStyle style, int colour) => new(name, delays, errors.Select(of).ToArray(), style, colour);
        ChartSeries[] series =
        [
            Series("hold last", error => error.HoldLastMetres, SeriesStyle.Line, 1),
            Series("velocity", error => error.VelocityMetres, SeriesStyle.Line, 2),
            Series("adaptive", error => error.AdaptiveMetres, SeriesStyle.Line, 0),
            Series("best in hindsight", error => error.BestInHindsightMetres, SeriesStyle.Dashed, 3),
            Series("linear, 20 taps, fitted to the motion", error => error.LinearMetres, SeriesStyle.Dashed, 4),
        ];
        return new LineChart(
            $"A hand told from the past: {motion.Name} motion",
            "Rms error of each way to predict a hand against the age of the newest sample.",
            [
                new ChartPanel("Rms error", "error (m)", series) { PlotHeight = 260 },
                new ChartPanel("The same, logarithmic", "error (m)", series) { Scale = ChartScale.Log10, LogFloor = ErrorFloor },
            ])
        {
            XLabel = "age of the newest sample (ms)",
        };
    }

    internal static LineChart OfMotion(HandMotion motion)
    {
        int[] samples = Enumerable.Range(0, motion.Count).ToArray();
        double[] seconds = samples.Select(n => n / (double)HandMotion.RateHertz).ToArray();
        ChartSeries Axis(string name, Func<Vector3D, double> of) => new(name, seconds, samples.Select(n => of(motion.PositionAt(n))).ToArray());
        return new LineChart(
            $"The hand: {motion.Name} motion",
            "Where the hand was against time.",
            [new ChartPanel("Position of the hand", "position (m)", [Axis("x", at => at.X), Axis("y", at => at.Y), Axis("z", at => at.Z)])]);
    }
}
