namespace LagSim.Harness.Experiments.Metrics;

/// <summary>The phase of a sample relative to an external event. Without an event all samples are <see cref="Before"/>.</summary>
public enum Phase
{
    /// <summary>Before the event's stamp.</summary>
    Before = 0,

    /// <summary>From the stamp until the last peer has dealt with the event.</summary>
    During = 1,

    /// <summary>After the last peer has dealt with it.</summary>
    After = 2,
}
