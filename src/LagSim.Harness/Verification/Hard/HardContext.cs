using System;
using System.Threading;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>The context of a hard case. One case at a time, on one thread.</summary>
public sealed class HardContext
{
    private readonly Action<double> progress;

    /// <summary>Creates a context.</summary>
    /// <param name="scale">The scale of the sizes.</param>
    /// <param name="seed">The seed of random numbers.</param>
    /// <param name="progress">Called from time to time with the fraction of the case that is done, 0 to 1.</param>
    /// <param name="cancellation">Ends it early, by an <see cref="OperationCanceledException"/>.</param>
    public HardContext(HardScale scale, ulong seed = 1, Action<double>? progress = null, CancellationToken cancellation = default)
    {
        Scale = scale;
        Seed = seed;
        Cancellation = cancellation;
        this.progress = progress ?? (_ => { });
    }

    /// <summary>The scale of the sizes.</summary>
    public HardScale Scale { get; }

    /// <summary>The seed of random numbers.</summary>
    public ulong Seed { get; }

    /// <summary>Cancels the case.</summary>
    public CancellationToken Cancellation { get; }

    /// <summary>Returns the sizes of this scale: all sizes at the full one, the quick ones at the small one.</summary>
    internal T[] Sizes<T>(T[] small, T[] full) => Scale == HardScale.Full ? full : small;

    internal T Size<T>(T small, T full) => Scale == HardScale.Full ? full : small;

    /// <summary>Reports the fraction of the case that is done.</summary>
    internal void Report(double part)
    {
        Cancellation.ThrowIfCancellationRequested();
        progress(part);
    }

    /// <summary>Creates a simulation that keeps a second of history, or a given length.</summary>
    internal Simulation Simulate(Scene scene, SimDuration? history = null) => new(scene, new SimulationOptions(default, history, cancellation: Cancellation));

    /// <summary>Creates a simulation that keeps everything, and runs it.</summary>
    internal Simulation Run(Scene scene, double seconds)
    {
        Simulation simulation = Simulate(scene, SimDuration.MaxValue);
        simulation.AdvanceTo(SimTime.FromSeconds(seconds));
        return simulation;
    }
}
