using System;
using System.Threading;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>What a hard case is run with. One case at a time, on one thread.</summary>
public sealed class HardContext
{
    private readonly Action<double> progress;

    /// <summary>A context.</summary>
    /// <param name="scale">How large the sizes are.</param>
    /// <param name="seed">The luck of what is drawn.</param>
    /// <param name="progress">Is told from time to time which part of the case is done, 0 to 1.</param>
    /// <param name="cancellation">Ends it early, by an <see cref="OperationCanceledException"/>.</param>
    public HardContext(HardScale scale, ulong seed = 1, Action<double>? progress = null, CancellationToken cancellation = default)
    {
        Scale = scale;
        Seed = seed;
        Cancellation = cancellation;
        this.progress = progress ?? (_ => { });
    }

    /// <summary>How large the sizes are.</summary>
    public HardScale Scale { get; }

    /// <summary>The luck of what is drawn.</summary>
    public ulong Seed { get; }

    /// <summary>Asks for an end.</summary>
    public CancellationToken Cancellation { get; }

    /// <summary>The sizes of this scale: all at the full one, those that are quick at the small one.</summary>
    internal T[] Sizes<T>(T[] small, T[] full) => Scale == HardScale.Full ? full : small;

    internal T Size<T>(T small, T full) => Scale == HardScale.Full ? full : small;

    /// <summary>Says which part of the case is done.</summary>
    internal void Report(double part)
    {
        Cancellation.ThrowIfCancellationRequested();
        progress(part);
    }

    /// <summary>A simulation that keeps a second of its past, or so much.</summary>
    internal Simulation Simulate(Scene scene, SimDuration? history = null) => new(scene, new SimulationOptions(default, history, cancellation: Cancellation));

    /// <summary>A simulation that has been run and keeps everything.</summary>
    internal Simulation Run(Scene scene, double seconds)
    {
        Simulation simulation = Simulate(scene, SimDuration.MaxValue);
        simulation.AdvanceTo(SimTime.FromSeconds(seconds));
        return simulation;
    }
}
