using LagSim.Events;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>A hand's event, and when a peer heard of it, by its own shared clock. Immutable.</summary>
/// <param name="Heard">When it was heard of.</param>
/// <param name="Event">A grab, a keyframe or a release.</param>
internal readonly record struct HandUpdate(SimTime Heard, ExternalEvent Event);
