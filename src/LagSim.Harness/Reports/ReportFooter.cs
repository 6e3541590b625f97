namespace LagSim.Harness.Reports;

/// <summary>The information needed to reproduce a report. Immutable.</summary>
/// <param name="Tool">The tool that made it, for example <c>lagsim</c>.</param>
/// <param name="Version">The tool's version.</param>
/// <param name="Seed">The seed of all random numbers.</param>
/// <param name="SceneHash">The hash of the scene in 16 hex digits; null where a report has several scenes.</param>
public sealed record ReportFooter(string Tool, string Version, ulong Seed, string? SceneHash);
