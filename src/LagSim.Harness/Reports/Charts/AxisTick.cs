namespace LagSim.Harness.Reports.Charts;

/// <summary>A grid line of an axis: its position in pixels from the axis' origin, and its label; a minor one has none.</summary>
internal readonly record struct AxisTick(double Pixel, string? Label);
