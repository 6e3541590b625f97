using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>An event's effect on one of the bodies it touched.</summary>
/// <param name="Key">The event.</param>
/// <param name="Kind"><c>impact</c>, <c>rest</c>, <c>wake</c>, or the external event's name.</param>
/// <param name="Body">The body.</param>
/// <param name="Other">The partner in an impact: a body's or a surface's name, one of several if it met several; empty for all other
/// events.</param>
/// <param name="State">The state of the body right after the event.</param>
public readonly record struct BodyEvent(EventKey Key, string Kind, BodyId Body, string Other, BodyState State);
