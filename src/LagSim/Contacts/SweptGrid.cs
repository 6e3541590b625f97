using System;
using System.Collections.Generic;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Contacts;

/// <summary>
/// A space-time index: a grid of cells in space for every eighth of a second, in which each body is listed wherever its centre's path leads. So it
/// knows the past and the precomputed future of everybody, not only where they are.
/// </summary>
/// <remarks>
/// <para>A path is listed a window ahead, as long as it stays within about a cell; at the window's end the body has to be asked for again. Two bodies that
/// meet are both listed for that time before it comes, and whichever was listed later has found the other.</para>
/// <para>Nothing is taken out of a cell: what no longer holds is a candidate too many, until its eighth of a second lies before the history. Who does not
/// move is listed once, apart, for as long as he stays; so are bodies too wide or too fast for the cells, who are everybody's candidates.</para>
/// <para>Cost: some ten cells a body and window, and what is listed in the cells around.</para>
/// </remarks>
internal sealed class SweptGrid : IPairIndex
{
    /// <summary>A slab of time is 2^37 ticks, 1/8 s.</summary>
    private const int SlabBits = 37;

    /// <summary>A window ends with the slab after the one it begins in.</summary>
    private const int SlabsAhead = 1;

    /// <summary>Who crosses a cell in less than this is too fast for the cells: 1/512 s.</summary>
    private const double ShortestCrossing = 1.0 / 512;

    /// <summary>Coordinates beyond so many cells share the last one: a long holds them, and a double tells them apart.</summary>
    private const double FurthestCell = 1L << 40;

    /// <summary>Who would be listed in more cells at a time is everybody's candidate instead.</summary>
    private const double MostCells = 512;

    private readonly TimelineStore timelines;
    private readonly PeriodicBox box;
    private readonly double cell;
    private readonly double margin;
    private readonly double tick; // metres that anybody moves in a tick, at most
    private readonly long cellsX;
    private readonly long cellsY;
    private readonly long cellsZ;
    private readonly Stack<CellTable<int>> spare = new();
    private readonly CellTable<Stay> stays = new(64);
    private CellTable<int>?[] slabs = new CellTable<int>?[16]; // by slab number, from firstSlab on
    private long firstSlab = long.MinValue;
    private int slabCount;
    private readonly List<Stay> everywhere = new();
    private Window[] windows = new Window[64];
    private int[] found = new int[64];
    private int foundCount;
    private uint[] foundBy = new uint[64]; // slot -> the query that found it last
    private uint query;
    private double widest; // radius of what is listed in cells

    /// <summary>An empty index.</summary>
    /// <param name="timelines">The paths.</param>
    /// <param name="cell">The least size of a cell, in metres: about two diameters of most bodies.</param>
    /// <param name="near">How far apart two bodies may be, in metres, that are still candidates.</param>
    /// <param name="tickLength">How far a body moves in a tick at most, in metres.</param>
    /// <param name="box">The box whose sides meet; empty if there is none.</param>
    internal SweptGrid(TimelineStore timelines, double cell, double near, double tickLength, PeriodicBox box)
    {
        this.timelines = timelines;
        this.box = box;
        this.cell = cell;
        margin = near;
        tick = tickLength;
        cellsX = CellsAlong(box.Size.X);
        cellsY = CellsAlong(box.Size.Y);
        cellsZ = CellsAlong(box.Size.Z);
    }

    /// <summary>How many bodies are everybody's candidates; if they are many, other cells would serve better.</summary>
    internal int EverywhereCount => everywhere.Count;

    public Span<int> Candidates(int slot, double radius, SimTime from, out SimTime until)
    {
        int segment = timelines.Last(slot);
        Reserve(slot);
        ref Window window = ref windows[slot];
        if (window.Serial != timelines.Serial(segment) || from < window.From || from >= window.Until)
        {
            window.Serial = timelines.Serial(segment);
            window.From = from;
            window.Until = List(slot, radius, segment, from, SimTime.MaxValue);
        }

        until = window.Until;
        Look(slot, radius, segment, from, until);
        return found.AsSpan(0, foundCount);
    }

    public Span<int> CandidatesAt(int slot, double radius, SimTime time)
    {
        Reserve(slot);
        Look(slot, radius + tick, timelines.Last(slot), time, time);
        return found.AsSpan(0, foundCount);
    }

    public void Add(int slot, double radius, int segment, SimTime from, SimTime until)
    {
        Reserve(slot);
        SimTime at = from;
        while (true)
        {
            SimTime listed = List(slot, radius, segment, at, until);
            if (listed >= until)
            {
                return;
            }

            at = listed;
        }
    }

    public void Forget(int slot)
    {
        everywhere.RemoveAll(stay => stay.Slot == slot);
        if (slot < windows.Length)
        {
            windows[slot] = default;
        }
    }

    public void DropBefore(SimTime edge)
    {
        long first = SlabOf(edge);
        while (slabCount > 0 && firstSlab < first)
        {
            CellTable<int>? oldest = slabs[0];
            if (oldest is not null)
            {
                oldest.Clear();
                spare.Push(oldest);
            }

            slabCount--;
            firstSlab++;
            Array.Copy(slabs, 1, slabs, 0, slabCount);
            slabs[slabCount] = null;
        }
    }

    /// <summary>Lists a piece of path from a time on, up to the end of its window or <paramref name="until"/>; returns which.</summary>
    private SimTime List(int slot, double radius, int segment, SimTime from, SimTime until)
    {
        ref readonly MotionSegment path = ref timelines.Segment(segment);
        if (radius > 0.5 * cell)
        {
            AddEverywhere(new Stay(slot, TimelineStore.None, 0));
            return SimTime.MaxValue;
        }

        widest = Math.Max(widest, radius);
        DenseOutput dense = timelines.Dense(segment);
        if (IsStill(path))
        {
            Cells at = CellsOf(path, dense, from, from, 0);
            stays.Add(at.Number(at.FromX, at.FromY, at.FromZ), new Stay(slot, segment, timelines.Serial(segment)));
            return SimTime.MaxValue;
        }

        double crossing = Crossing(path, dense, from);
        if (crossing < ShortestCrossing)
        {
            AddEverywhere(new Stay(slot, segment, timelines.Serial(segment)));
            return SimTime.MaxValue;
        }

        SimTime end = SimTime.Min(until, EndOfSlab(SlabOf(from) + SlabsAhead));
        end = SimTime.Min(end, Later(from, crossing));
        end = SimTime.Min(end, SimTime.Max(path.End, Later(from, ShortestCrossing)));
        for (SimTime at = from; ;)
        {
            SimTime next = SimTime.Min(end, EndOfSlab(SlabOf(at)));
            Cells cells = CellsOf(path, dense, at, next, 0);
            CellTable<int> slab = Slab(SlabOf(at));
            for (long x = cells.FromX; x <= cells.ToX; x++)
            {
                for (long y = cells.FromY; y <= cells.ToY; y++)
                {
                    for (long z = cells.FromZ; z <= cells.ToZ; z++)
                    {
                        ulong number = cells.Number(x, y, z);
                        int head = slab.First(number);
                        if (head == CellTable<int>.None || slab.Cell(head) != number || slab.Value(head) != slot)
                        {
                            slab.Add(number, slot);
                        }
                    }
                }
            }

            if (next >= end)
            {
                return end;
            }

            at = next;
        }
    }

    private void AddEverywhere(Stay stay)
    {
        for (int i = 0; i < everywhere.Count; i++)
        {
            if (everywhere[i].Slot == stay.Slot && (everywhere[i].Segment == TimelineStore.None || everywhere[i].Serial == stay.Serial))
            {
                return;
            }
        }

        everywhere.Add(stay);
    }

    /// <summary>Finds whom a piece of path may touch in a span, who stands around it included.</summary>
    private void Look(int slot, double radius, int segment, SimTime from, SimTime until)
    {
        foundCount = 0;
        if (++query == 0)
        {
            Array.Clear(foundBy, 0, foundBy.Length);
            query = 1;
        }

        for (int i = everywhere.Count - 1; i >= 0; i--)
        {
            if (IsOver(everywhere[i]))
            {
                everywhere[i] = everywhere[everywhere.Count - 1];
                everywhere.RemoveAt(everywhere.Count - 1);
            }
            else
            {
                Find(everywhere[i].Slot);
            }
        }

        ref readonly MotionSegment path = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        double around = radius + widest + margin;
        SimTime last = slabCount == 0 ? from : EndOfSlab(firstSlab + slabCount - 1);
        bool isStill = IsStill(path);
        for (SimTime at = from; ;)
        {
            SimTime next = SimTime.Min(SimTime.Min(until, last), EndOfSlab(SlabOf(at)));
            next = SimTime.Max(next, at);
            bool isLast = next >= until || next >= last;
            Cells cells = CellsOf(path, dense, at, next, around);
            if (cells.Count > MostCells)
            {
                FindAll();
                return;
            }

            CellTable<int>? slab = SlabIfAny(SlabOf(at));
            CellTable<int>? ending = at == from ? SlabIfAny(SlabOf(at - SimDuration.OneTick)) : null; // who is listed to this very instant, if a slab begins with it
            bool looksForStays = !isStill || at == from;
            for (long x = cells.FromX; x <= cells.ToX; x++)
            {
                for (long y = cells.FromY; y <= cells.ToY; y++)
                {
                    for (long z = cells.FromZ; z <= cells.ToZ; z++)
                    {
                        ulong number = cells.Number(x, y, z);
                        if (slab is not null)
                        {
                            FindIn(slab, number);
                        }

                        if (ending is not null && ending != slab)
                        {
                            FindIn(ending, number);
                        }

                        if (looksForStays)
                        {
                            FindStays(number);
                        }
                    }
                }
            }

            if (isLast)
            {
                return;
            }

            at = next;
        }
    }

    private void FindIn(CellTable<int> slab, ulong number)
    {
        for (int entry = slab.First(number); entry != CellTable<int>.None; entry = slab.Next(entry))
        {
            if (slab.Cell(entry) == number)
            {
                Find(slab.Value(entry));
            }
        }
    }

    private void FindStays(ulong number)
    {
        int before = CellTable<Stay>.None;
        for (int entry = stays.First(number); entry != CellTable<Stay>.None;)
        {
            int next = stays.Next(entry);
            if (IsOver(stays.Value(entry)))
            {
                stays.Remove(before, entry);
            }
            else
            {
                before = entry;
                if (stays.Cell(entry) == number)
                {
                    Find(stays.Value(entry).Slot);
                }
            }

            entry = next;
        }
    }

    private void FindAll()
    {
        for (int slot = 0; slot < windows.Length; slot++)
        {
            Find(slot);
        }
    }

    private void Find(int slot)
    {
        if (foundBy[slot] == query || !timelines.IsKnown(slot))
        {
            return; // found already, or of a body that is forgotten
        }

        foundBy[slot] = query;
        if (foundCount == found.Length)
        {
            Array.Resize(ref found, foundCount * 2);
        }

        found[foundCount++] = slot;
    }

    private bool IsOver(in Stay stay) => stay.Segment != TimelineStore.None && timelines.Serial(stay.Segment) != stay.Serial;

    private void Reserve(int slot)
    {
        if (slot >= windows.Length)
        {
            int size = Math.Max(slot + 1, windows.Length * 2);
            Array.Resize(ref windows, size);
            Array.Resize(ref foundBy, size);
        }
    }

    private static bool IsStill(in MotionSegment path) =>
        path.Law == MotionLaw.Resting || (path.Law == MotionLaw.Ballistic && path.Velocity == Vector3D.Zero && path.Acceleration == Vector3D.Zero);

    /// <summary>In how many seconds a path leads a cell further, at the earliest.</summary>
    private double Crossing(in MotionSegment path, in DenseOutput dense, SimTime from)
    {
        double seconds = from.SecondsSince(path.Epoch);
        double speed = path.VelocityAt(seconds, dense).Length;
        double acceleration = LargestAcceleration(path, dense, seconds, seconds + 1);
        return 2 * cell / (speed + Math.Sqrt((speed * speed) + (2 * acceleration * cell)));
    }

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

    /// <summary>The cells that a path leads through in a span within one slab, and what is around it.</summary>
    private Cells CellsOf(in MotionSegment path, in DenseOutput dense, SimTime from, SimTime until, double around)
    {
        double start = from.SecondsSince(path.Epoch);
        double end = until.SecondsSince(path.Epoch);
        Vector3D a = path.PositionAt(start, dense);
        Vector3D b = path.PositionAt(end, dense);

        // No path strays further from its chord than a parabola of the largest acceleration. The rest is for rounding.
        double bulge = path.Law == MotionLaw.Resting ? 0 : 0.125 * (end - start) * (end - start) * LargestAcceleration(path, dense, start, end);
        double slack = around + bulge + (1e-12 * (Size(a) + Size(b)));
        return new Cells
        {
            Grid = this,
            FromX = CellOf(Math.Min(a.X, b.X) - slack, cellsX, box.Size.X),
            ToX = CellOf(Math.Max(a.X, b.X) + slack, cellsX, box.Size.X),
            FromY = CellOf(Math.Min(a.Y, b.Y) - slack, cellsY, box.Size.Y),
            ToY = CellOf(Math.Max(a.Y, b.Y) + slack, cellsY, box.Size.Y),
            FromZ = CellOf(Math.Min(a.Z, b.Z) - slack, cellsZ, box.Size.Z),
            ToZ = CellOf(Math.Max(a.Z, b.Z) + slack, cellsZ, box.Size.Z),
        }.Whole();
    }

    private static double Size(in Vector3D v) => Math.Max(Math.Abs(v.X), Math.Max(Math.Abs(v.Y), Math.Abs(v.Z)));

    private long CellsAlong(double side) => side > 0 ? Math.Max(1, (long)Math.Min(side / cell, 1 << 20)) : 0;

    private long CellOf(double coordinate, long cells, double side)
    {
        double at = cells > 0 ? coordinate * (cells / side) : coordinate / cell;
        return (long)Math.Max(-FurthestCell, Math.Min(FurthestCell, Math.Floor(at)));
    }

    private static long SlabOf(SimTime time) => time.Ticks >> SlabBits;

    private static SimTime EndOfSlab(long slab) =>
        slab >= long.MaxValue >> SlabBits ? SimTime.MaxValue : SimTime.FromTicks((slab + 1) << SlabBits);

    private static SimTime Later(SimTime from, double seconds) =>
        TickConversion.TryFromSeconds(seconds, out long ticks) && ticks < SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(Math.Max(1, ticks))
            : SimTime.MaxValue;

    private CellTable<int>? SlabIfAny(long number) =>
        number >= firstSlab && number < firstSlab + slabCount ? slabs[number - firstSlab] : null;

    private CellTable<int> Slab(long number)
    {
        if (slabCount == 0)
        {
            firstSlab = number;
        }

        if (number < firstSlab)
        {
            int missing = (int)(firstSlab - number);
            CellTable<int>?[] shifted = new CellTable<int>?[Math.Max(slabs.Length, slabCount + missing)];
            Array.Copy(slabs, 0, shifted, missing, slabCount);
            slabs = shifted;
            firstSlab = number;
            slabCount += missing;
        }

        int at = (int)(number - firstSlab);
        if (at >= slabs.Length)
        {
            Array.Resize(ref slabs, Math.Max(at + 1, slabs.Length * 2));
        }

        slabCount = Math.Max(slabCount, at + 1);
        return slabs[at] ??= spare.Count > 0 ? spare.Pop() : new CellTable<int>(at > 0 && slabs[at - 1] is { } before ? before.Capacity : 64);
    }

    /// <summary>A block of cells; in a periodic box it may reach over a side, but not around the box.</summary>
    private struct Cells
    {
        internal SweptGrid Grid;
        internal long FromX;
        internal long ToX;
        internal long FromY;
        internal long ToY;
        internal long FromZ;
        internal long ToZ;

        internal readonly double Count => (ToX - FromX + 1.0) * (ToY - FromY + 1.0) * (ToZ - FromZ + 1.0);

        internal Cells Whole()
        {
            ToX = Grid.cellsX > 0 ? Math.Min(ToX, FromX + Grid.cellsX - 1) : ToX;
            ToY = Grid.cellsY > 0 ? Math.Min(ToY, FromY + Grid.cellsY - 1) : ToY;
            ToZ = Grid.cellsZ > 0 ? Math.Min(ToZ, FromZ + Grid.cellsZ - 1) : ToZ;
            return this;
        }

        /// <summary>The number of a cell; cells far apart may share one.</summary>
        internal readonly ulong Number(long x, long y, long z) =>
            ((ulong)Around(x, Grid.cellsX) * 0x8DA6B343D8163841UL) ^ ((ulong)Around(y, Grid.cellsY) * 0xD8163841CB1AB31FUL) ^ ((ulong)Around(z, Grid.cellsZ) * 0xCB1AB31F8DA6B343UL);

        private static long Around(long at, long cells)
        {
            if (cells == 0)
            {
                return at;
            }

            long rest = at % cells;
            return rest < 0 ? rest + cells : rest;
        }
    }

    /// <summary>A body that is a candidate for as long as a piece of its path is kept; without a piece, for as long as the body is.</summary>
    private readonly struct Stay
    {
        internal Stay(int slot, int segment, long serial)
        {
            Slot = slot;
            Segment = segment;
            Serial = serial;
        }

        internal int Slot { get; }

        internal int Segment { get; }

        internal long Serial { get; }
    }

    /// <summary>For which piece of path, and which span of it, a body is listed.</summary>
    private struct Window
    {
        internal long Serial;
        internal SimTime From;
        internal SimTime Until;
    }
}
