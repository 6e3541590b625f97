namespace LagSim.Tests.Architecture;

/// <summary>A type that counts as part of another layer than its folder's.</summary>
/// <param name="Type">Its full name.</param>
/// <param name="Layer">The name in <see cref="Layers.Order"/> that it counts as part of.</param>
/// <param name="Reason">Why it is not in such a folder.</param>
internal sealed record PlacedType(string Type, string Layer, string Reason);
