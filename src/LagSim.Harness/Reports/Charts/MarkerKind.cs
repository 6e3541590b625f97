namespace LagSim.Harness.Reports.Charts;

/// <summary>How a moment is marked.</summary>
public enum MarkerKind
{
    /// <summary>A thin vertical line across the panel with its label above the plot: for the few moments that matter.</summary>
    Line = 0,

    /// <summary>A small triangle beneath the x axis, explained once in the legend: for the many, such as impacts.</summary>
    Tick = 1,
}
