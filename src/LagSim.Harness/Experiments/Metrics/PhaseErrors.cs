using System;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>The errors of a run, kept apart by <see cref="Phase"/>.</summary>
/// <remarks>Not thread-safe, as its accumulators are not.</remarks>
public sealed class PhaseErrors
{
    /// <summary>Errors of samples before the event.</summary>
    public ErrorAccumulator Before { get; } = new();

    /// <summary>Errors of samples from the event's stamp until the last peer has dealt with it.</summary>
    public ErrorAccumulator During { get; } = new();

    /// <summary>Errors of samples after that.</summary>
    public ErrorAccumulator After { get; } = new();

    /// <summary>The accumulator of one phase.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="phase"/> is not one of the three.</exception>
    public ErrorAccumulator this[Phase phase] => phase switch
    {
        Phase.Before => Before,
        Phase.During => During,
        Phase.After => After,
        _ => throw new ArgumentOutOfRangeException(nameof(phase), phase, "A phase is Before, During or After."),
    };
}
