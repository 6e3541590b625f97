using LagSim.Testing.Links;

namespace LagSim.Testing.Running;

/// <summary>A client of a test.</summary>
/// <param name="Link">The profile of its link to the host.</param>
/// <param name="AsksAtSeconds">When it asks to join, in seconds since the start; null for one that is there from the start.</param>
internal sealed record PlannedClient(LinkProfile Link, double? AsksAtSeconds);
