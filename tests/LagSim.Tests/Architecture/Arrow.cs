namespace LagSim.Tests.Architecture;

/// <summary>One type's use of another, with the folder of each.</summary>
internal sealed record Arrow(string FromFolder, string From, string ToFolder, string To);
