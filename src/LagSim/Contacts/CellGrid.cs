using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>Space in cubes, or, in a periodic box, in as many equal cells along each side as fit: which of them a path leads through.</summary>
internal sealed class CellGrid
{
    /// <summary>Coordinates beyond so many cells share the last one: a long holds them, and a double tells them apart.</summary>
    private const double FurthestCell = 1L << 40;

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

    /// <summary>In how many seconds a path leads a cell further, at the earliest.</summary>
    internal double Crossing(in MotionSegment path, in DenseOutput dense, SimTime from)
    {
        double seconds = from.SecondsSince(path.Epoch);
        double speed = path.VelocityAt(seconds, dense).Length;
        double acceleration = LargestAcceleration(path, dense, seconds, seconds + 1);
        return 2 * size / (speed + Math.Sqrt((speed * speed) + (2 * acceleration * size)));
    }

    /// <summary>The cells that a path leads through in a span, and those within a distance of it, in metres.</summary>
    internal CellBlock Around(in MotionSegment path, in DenseOutput dense, SimTime from, SimTime until, double distance)
    {
        double start = from.SecondsSince(path.Epoch);
        double end = until.SecondsSince(path.Epoch);
        Vector3D a = path.PositionAt(start, dense);
        Vector3D b = path.PositionAt(end, dense);

        // No path strays further from its chord than a parabola of the largest acceleration. The rest is for rounding.
        double bulge = path.Law == MotionLaw.Resting ? 0 : 0.125 * (end - start) * (end - start) * LargestAcceleration(path, dense, start, end);
        double slack = distance + bulge + (1e-12 * (Largest(a) + Largest(b)));
        return new CellBlock(
            Range(a.X, b.X, slack, alongX, box.Size.X), Range(a.Y, b.Y, slack, alongY, box.Size.Y), Range(a.Z, b.Z, slack, alongZ, box.Size.Z));
    }

    /// <summary>The number of a cell; cells far apart may share one.</summary>
    internal ulong Number(long x, long y, long z) =>
        ((ulong)Wrapped(x, alongX) * 0x8DA6B343D8163841UL) ^ ((ulong)Wrapped(y, alongY) * 0xD8163841CB1AB31FUL) ^ ((ulong)Wrapped(z, alongZ) * 0xCB1AB31F8DA6B343UL);

    private static double LargestAcceleration(in MotionSegment path, in DenseOutput dense, double from, double until)
    {
        double largest = path.Acceleration.Length;
        if (path.IsDense)
        {
            double s = Math.Max(Math.Abs(from), Math.Abs(until));
            largest += ((6 * dense.Cubic.Length) + (((12 * dense.Quartic.Length) + (20 * s * dense.Quintic.Length)) * s)) * s;
        }

        return largest;
    }

    private static double Largest(in Vector3D v) => Math.Max(Math.Abs(v.X), Math.Max(Math.Abs(v.Y), Math.Abs(v.Z)));

    private static long Wrapped(long at, long cells)
    {
        if (cells == 0)
        {
            return at;
        }

        long rest = at % cells;
        return rest < 0 ? rest + cells : rest;
    }

    private long CellsAlong(double side) => side > 0 ? Math.Max(1, (long)Math.Min(side / size, 1 << 20)) : 0;

    /// <summary>The cells along one axis; in a box they may reach over a side, but not around.</summary>
    private CellRange Range(double a, double b, double slack, long cells, double side)
    {
        long from = CellOf(Math.Min(a, b) - slack, cells, side);
        long to = CellOf(Math.Max(a, b) + slack, cells, side);
        return new CellRange(from, cells > 0 ? Math.Min(to, from + cells - 1) : to);
    }

    private long CellOf(double coordinate, long cells, double side)
    {
        double at = cells > 0 ? coordinate * (cells / side) : coordinate / size;
        return (long)Math.Max(-FurthestCell, Math.Min(FurthestCell, Math.Floor(at)));
    }
}
