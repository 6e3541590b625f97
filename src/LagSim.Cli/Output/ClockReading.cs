using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>What a client knows of the host's clock.</summary>
/// <param name="Offset">The host's clock minus its own.</param>
/// <param name="Bound">The most by which that may be wrong.</param>
/// <param name="Delay">One way, if it takes as long there as back, which cannot be told.</param>
internal readonly record struct ClockReading(SimDuration Offset, SimDuration Bound, SimDuration Delay);
