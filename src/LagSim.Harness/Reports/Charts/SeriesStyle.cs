namespace LagSim.Harness.Reports.Charts;

/// <summary>How a series is drawn.</summary>
public enum SeriesStyle
{
    /// <summary>A solid line from point to point.</summary>
    Line = 0,

    /// <summary>Each value holds until the next point.</summary>
    Step = 1,

    /// <summary>Dots without a line.</summary>
    Points = 2,

    /// <summary>A dashed line; over a solid one both stay visible where they coincide.</summary>
    Dashed = 3,
}
