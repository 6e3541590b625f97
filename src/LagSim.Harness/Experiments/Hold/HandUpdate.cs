using LagSim.Events;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>An event of a hand, and when a peer received it, by its own shared clock. Immutable.</summary>
/// <param name="Heard">The time of receipt.</param>
/// <param name="Event">A grab, a keyframe or a release.</param>
internal readonly record struct HandUpdate(SimTime Heard, ExternalEvent Event);
