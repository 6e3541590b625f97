using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>What an event did to one of the bodies it touched.</summary>
/// <param name="Key">The event.</param>
/// <param name="Kind"><c>impact</c>, <c>rest</c>, <c>wake</c>, or the external event's name.</param>
/// <param name="Body">The body.</param>
/// <param name="Other">What it met in an impact: a body's or a surface's name, of several it met one; empty for all other events.</param>
/// <param name="State">The body right after.</param>
public readonly record struct BodyEvent(EventKey Key, string Kind, BodyId Body, string Other, BodyState State);
