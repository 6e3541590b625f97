namespace LagSim.Harness.Reports;

/// <summary>What it takes to make a report again. Immutable.</summary>
/// <param name="Tool">The tool that made it, for example <c>lagsim</c>.</param>
/// <param name="Version">The tool's version.</param>
/// <param name="Seed">The seed of all that was random.</param>
/// <param name="SceneHash">The hash of the scene in 16 hex digits; null where a report has several scenes.</param>
public sealed record ReportFooter(string Tool, string Version, ulong Seed, string? SceneHash);
