using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>A client's estimate of the host's clock.</summary>
/// <param name="Offset">The host's clock minus its own.</param>
/// <param name="Bound">The largest possible error of that estimate.</param>
/// <param name="Delay">The one-way delay, assuming both directions take equally long, which cannot be measured.</param>
internal readonly record struct ClockReading(SimDuration Offset, SimDuration Bound, SimDuration Delay);
