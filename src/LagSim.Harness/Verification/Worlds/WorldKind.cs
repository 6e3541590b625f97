namespace LagSim.Harness.Verification.Worlds;

/// <summary>The kinds of worlds that are drawn. Their order decides which seed has which: never reorder.</summary>
public enum WorldKind
{
    /// <summary>Balls in a closed room or a periodic box, mostly elastic and without friction.</summary>
    Gas,

    /// <summary>Elastic balls of ordinary masses in a narrow pit.</summary>
    ElasticPit,

    /// <summary>Inelastic balls, with friction or without, in a narrow pit.</summary>
    InelasticPit,

    /// <summary>Balls that hardly have room in a closed room, and hands among them.</summary>
    JammedRoom,

    /// <summary>Light balls with drag that lie on a floor and are thrown at any speed that a player may give.</summary>
    DragOnFloor,

    /// <summary>Balls on springs, above a floor.</summary>
    Springs,

    /// <summary>Balls in a magnetic field and under the Magnus force, on a floor.</summary>
    Magnetic,

    /// <summary>Balls around a static sphere that pulls them.</summary>
    Planet,

    /// <summary>Balls on a slope that ends in a corner.</summary>
    Slope,

    /// <summary>A row of balls that touch or nearly touch.</summary>
    Chain,

    /// <summary>Balls whose masses differ up to a millionfold, in a walled room.</summary>
    UnequalMasses,

    /// <summary>Balls and surfaces with collision filters, which players change.</summary>
    Filters,

    /// <summary>Balls that cross sensors, some of them carried by other balls.</summary>
    Sensors,

    /// <summary>Balls whose game has rules that spawn, remove and push.</summary>
    Rules,
}
