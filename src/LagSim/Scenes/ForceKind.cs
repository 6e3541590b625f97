namespace LagSim.Scenes;

/// <summary>The kind of a <see cref="Force"/>. The numbers are part of wire and hashes: never renumber.</summary>
public enum ForceKind : byte
{
    /// <summary>An <see cref="IAcceleration"/> that a program supplies.</summary>
    Supplied = 0,

    /// <summary>Drag proportional to the speed through a medium: F = -c (v - w).</summary>
    LinearDrag = 1,

    /// <summary>Drag proportional to the square of the speed through a medium: F = -k |v - w| (v - w).</summary>
    QuadraticDrag = 2,

    /// <summary>A spring of length zero to an anchor, with a damper: F = -k (x - a) - c v.</summary>
    Spring = 3,

    /// <summary>A charge in a uniform magnetic field: F = q v x B.</summary>
    Magnetic = 4,

    /// <summary>A pull to a centre, the same acceleration for every mass: a = -s |r|^p r / |r|, r = x - c.</summary>
    Central = 5,

    /// <summary>The force of a medium on a body that turns: F = s w x v, w the spin.</summary>
    Magnus = 6,
}
