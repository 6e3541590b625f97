namespace LagSim.Harness.Reports.Charts;

/// <summary>The marker of the points of a series. Open shapes do not hide what lies beneath them.</summary>
public enum PointShape
{
    /// <summary>A filled disc.</summary>
    Disc = 0,

    /// <summary>A filled square.</summary>
    Square = 1,

    /// <summary>A filled diamond.</summary>
    Diamond = 2,

    /// <summary>A filled triangle on its side.</summary>
    Triangle = 3,

    /// <summary>A filled triangle on its tip.</summary>
    TriangleDown = 4,

    /// <summary>An upright cross.</summary>
    Plus = 5,

    /// <summary>An open square.</summary>
    OpenSquare = 6,

    /// <summary>A slanting cross.</summary>
    Cross = 7,

    /// <summary>An open triangle on its side.</summary>
    OpenTriangle = 8,

    /// <summary>An open diamond.</summary>
    OpenDiamond = 9,

    /// <summary>An open circle.</summary>
    Circle = 10,

    /// <summary>An open triangle on its tip.</summary>
    OpenTriangleDown = 11,
}
