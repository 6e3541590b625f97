namespace LagSim.Harness.Reports.Charts;

/// <summary>How an axis maps values to positions.</summary>
public enum ChartScale
{
    /// <summary>Equal differences take equal space.</summary>
    Linear = 0,

    /// <summary>Equal ratios take equal space. Zero has a separate line beneath the lowest decade.</summary>
    Log10 = 1,
}
