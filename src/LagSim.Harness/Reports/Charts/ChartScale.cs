namespace LagSim.Harness.Reports.Charts;

/// <summary>How an axis maps values to places.</summary>
public enum ChartScale
{
    /// <summary>Equal differences take equal space.</summary>
    Linear = 0,

    /// <summary>Equal ratios take equal space. Zero has a line of its own beneath the lowest decade.</summary>
    Log10 = 1,
}
