using System;
using LagSim.Scenes;

namespace LagSim.BroadPhase;

/// <summary>Space in cubes, or, in a periodic box, in as many equal cells along each side as fit: which of them are near a point.</summary>
internal sealed class CellGrid
{
    /// <summary>
    /// The number of cells beyond which coordinates share the last one: a long holds that many, and a double distinguishes them.
    /// </summary>
    private const double FurthestCell = 1L << 40;

    private const int AxisBits = 21;
    private const ulong AxisMask = (1UL << AxisBits) - 1;

    private readonly double size;
    private readonly PeriodicBox box;
    private readonly long alongX; // how many cells lie along a side of the box; 0 without one
    private readonly long alongY;
    private readonly long alongZ;

    /// <summary>Cells of at least that size, in metres.</summary>
    internal CellGrid(double size, in PeriodicBox box)
    {
        this.size = size;
        this.box = box;
        alongX = CellsAlong(box.Size.X);
        alongY = CellsAlong(box.Size.Y);
        alongZ = CellsAlong(box.Size.Z);
    }

    /// <summary>The cell of a point.</summary>
    internal ulong NumberAt(in Vector3D point) =>
        Number(CellOf(point.X, alongX, box.Size.X), CellOf(point.Y, alongY, box.Size.Y), CellOf(point.Z, alongZ, box.Size.Z));

    /// <summary>The cells within a distance of a point, in metres.</summary>
    internal CellBlock Around(in Vector3D point, double distance) => new(
        Range(point.X, distance, alongX, box.Size.X), Range(point.Y, distance, alongY, box.Size.Y), Range(point.Z, distance, alongZ, box.Size.Z));

    /// <summary>The number of a cell; cells two million along an axis from each other share one, and none that are nearer.</summary>
    internal ulong Number(long x, long y, long z) =>
        ((ulong)Wrapped(x, alongX) & AxisMask)
        | (((ulong)Wrapped(y, alongY) & AxisMask) << AxisBits)
        | (((ulong)Wrapped(z, alongZ) & AxisMask) << (2 * AxisBits));

    /// <summary>
    /// The number of a list out of a power of two that a cell falls to: cells in a row along x have lists in a row, for they are looked
    /// into one after the other.
    /// </summary>
    internal static int Bucket(ulong number, int lists)
    {
        uint x = (uint)(number & AxisMask);
        uint y = (uint)((number >> AxisBits) & AxisMask);
        uint z = (uint)(number >> (2 * AxisBits));
        return (int)((x + (y * 0x9E3779B1U) + (z * 0x85EBCA77U)) & (uint)(lists - 1));
    }

    private static long Wrapped(long at, long cells)
    {
        if (cells == 0)
        {
            return at;
        }

        // Paths are opened again long before they are a side away, so that a step or two do.
        while (at < 0)
        {
            at += cells;
        }

        while (at >= cells)
        {
            at -= cells;
        }

        return at;
    }

    private long CellsAlong(double side) => side > 0 ? Math.Max(1, (long)Math.Min(side / size, 1 << 20)) : 0;

    /// <summary>The cells along one axis; in a box they may reach over a side, but not around.</summary>
    private CellRange Range(double at, double distance, long cells, double side)
    {
        long from = CellOf(at - distance, cells, side);
        long to = CellOf(at + distance, cells, side);
        return new CellRange(from, cells > 0 ? Math.Min(to, from + cells - 1) : to);
    }

    private long CellOf(double coordinate, long cells, double side)
    {
        double at = cells > 0 ? coordinate * (cells / side) : coordinate / size;
        return (long)Math.Max(-FurthestCell, Math.Min(FurthestCell, Math.Floor(at)));
    }
}
