
namespace LagSim.BroadPhase;

/// <summary>A block of cells, from and to inclusive along each axis.</summary>
internal readonly struct CellBlock
{
    internal CellBlock(CellRange x, CellRange y, CellRange z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    internal CellRange X { get; }

    internal CellRange Y { get; }

    internal CellRange Z { get; }

    /// <summary>How many cells; more than a long holds where a path leads far.</summary>
    internal double Count => X.Count * Y.Count * Z.Count;
}
