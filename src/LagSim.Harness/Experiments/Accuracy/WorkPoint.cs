namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>One point of a work-precision diagram: what a method reached on a scene at one setting, and what it cost. Immutable.</summary>
/// <param name="Scene">The scene.</param>
/// <param name="Method">The method or engine.</param>
/// <param name="Setting">The step or tolerance, in words: <c>1/60 s</c>.</param>
/// <param name="StepSeconds">The step in seconds; NaN for a method that has none.</param>
/// <param name="Error">The error; NaN where the state was not finite.</param>
/// <param name="ErrorKind">The kind of error, with its unit after an underscore.</param>
/// <param name="CpuSeconds">The least CPU time of several runs after a warm-up, in seconds, to build the world and simulate all of
/// it.</param>
/// <param name="Runs">The number of runs.</param>
/// <param name="SimulatedSeconds">The simulated time, in seconds.</param>
/// <param name="Events">Events of an event-driven engine, steps of any other.</param>
public sealed record WorkPoint(
    string Scene, string Method, string Setting, double StepSeconds, double Error, string ErrorKind, double CpuSeconds, int Runs, double SimulatedSeconds,
        long Events)
{
    /// <summary>Simulated seconds per second of CPU time.</summary>
    public double Speed => SimulatedSeconds / CpuSeconds;
}
