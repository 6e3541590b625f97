namespace LagSim.Harness.Experiments.Metrics;

/// <summary>The statistics of an error over many samples: their number, sizes, and bitwise differences.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> stands for no sample at all: every value is zero.</remarks>
/// <param name="Samples">How many errors were measured. Stalled samples without a measured error are not among them.</param>
/// <param name="MaxMetres">The largest error, in metres; 0 without a sample.</param>
/// <param name="MeanMetres">The arithmetic mean of the errors, in metres; 0 without a sample.</param>
/// <param name="RmsMetres">The root of the mean of the squared errors, in metres; 0 without a sample.</param>
/// <param name="DifferingBits">How many measured samples differed in at least one bit, however small their error.</param>
/// <param name="StalledSamples">The number of samples for which a peer's frame did not cover the requested time.</param>
public readonly record struct ErrorStatistics(
    long Samples,
    double MaxMetres,
    double MeanMetres,
    double RmsMetres,
    long DifferingBits,
    long StalledSamples)
{
    /// <summary>The statistics of no samples: all zeros.</summary>
    public static ErrorStatistics None => default;
}
