namespace LagSim.Harness.Reports.Charts;

/// <summary>The kind of marker of an instant.</summary>
public enum MarkerKind
{
    /// <summary>A thin vertical line across the panel with its label above the plot, for the few important instants.</summary>
    Line = 0,

    /// <summary>A small triangle beneath the x axis, explained once in the legend, for frequent events such as impacts.</summary>
    Tick = 1,
}
