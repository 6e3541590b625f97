using System;
using MathNet.Numerics;
using MathNet.Numerics.Statistics;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>Accumulates errors one by one in constant memory.</summary>
/// <remarks>Not thread-safe. Deterministic: the same errors in the same order give the same statistics.</remarks>
public sealed class ErrorAccumulator
{
    private readonly RunningStatistics _errors = new();
    private readonly RunningStatistics _squares = new();
    private double _max; // kept apart: MathNet's maximum of nothing is NaN
    private long _differing;
    private long _stalled;

    // Native providers may sum in another order than the managed one: reports are to be the same on every machine.
    static ErrorAccumulator() => Control.UseManaged();

    /// <summary>Adds one measured sample.</summary>
    /// <param name="errorMetres">The size of the error in metres: finite, not negative.</param>
    /// <param name="anyBitDiffers">Whether the compared states differ in any bit, even one that does not move the body.</param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="errorMetres"/> is negative, NaN or infinite.</exception>
    public void Add(double errorMetres, bool anyBitDiffers)
    {
        if (!double.IsFinite(errorMetres) || errorMetres < 0.0)
        {
            throw new ArgumentOutOfRangeException(nameof(errorMetres), errorMetres, "An error is a finite distance, zero or more.");
        }

        _errors.Push(errorMetres);
        _squares.Push(errorMetres * errorMetres);
        _max = Math.Max(_max, errorMetres);
        _differing += anyBitDiffers ? 1 : 0;
    }

    /// <summary>Counts a sample for which a peer's frame did not cover the requested time.</summary>
    /// <remarks>It adds no error. Where the peer showed an older frame instead, call <see cref="Add"/> for that error as well.</remarks>
    public void AddStalled() => _stalled++;

    /// <summary>Returns the statistics so far.</summary>
    public ErrorStatistics ToStatistics() => _errors.Count == 0
        ? new ErrorStatistics(0, 0.0, 0.0, 0.0, 0, _stalled)
        : new ErrorStatistics(_errors.Count, _max, _errors.Mean, Math.Sqrt(_squares.Mean), _differing, _stalled);
}
