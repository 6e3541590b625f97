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
    /// <summary>A window ends with the slab after the one it begins in.</summary>
    private const int SlabsAhead = 1;

    /// <summary>Who crosses a cell in less than this is too fast for the cells: 1/512 s.</summary>
    private const double ShortestCrossing = 1.0 / 512;

    /// <summary>Who would be listed in more cells at a time is everybody's candidate instead.</summary>
    private const double MostCells = 512;

    private readonly TimelineStore timelines;
    private readonly CellGrid grid;
    private readonly SlabRing slabs = new();
    private readonly double cell;
    private readonly double margin;
    private readonly double tick; // metres that anybody moves in a tick, at most
    private readonly CellTable<Stay> stays = new(64);
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
        grid = new CellGrid(cell, box);
        this.cell = cell;
        margin = near;
        tick = tickLength;
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

    public void DropBefore(SimTime edge) => slabs.DropBefore(edge);

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
            CellBlock at = grid.Around(path, dense, from, from, 0);
            stays.Add(grid.Number(at.X.From, at.Y.From, at.Z.From), new Stay(slot, segment, timelines.Serial(segment)));
            return SimTime.MaxValue;
        }

        double crossing = grid.Crossing(path, dense, from);
        if (crossing < ShortestCrossing)
        {
            AddEverywhere(new Stay(slot, segment, timelines.Serial(segment)));
            return SimTime.MaxValue;
        }

        SimTime end = SimTime.Min(until, SlabRing.EndOf(SlabRing.NumberOf(from) + SlabsAhead));
        end = SimTime.Min(end, Later(from, crossing));
        end = SimTime.Min(end, SimTime.Max(path.End, Later(from, ShortestCrossing)));
        for (SimTime at = from; ;)
        {
            SimTime next = SimTime.Min(end, SlabRing.EndOf(SlabRing.NumberOf(at)));
            CellBlock cells = grid.Around(path, dense, at, next, 0);
            CellTable<int> slab = slabs.Get(SlabRing.NumberOf(at));
            for (long x = cells.X.From; x <= cells.X.To; x++)
            {
                for (long y = cells.Y.From; y <= cells.Y.To; y++)
                {
                    for (long z = cells.Z.From; z <= cells.Z.To; z++)
                    {
                        ulong number = grid.Number(x, y, z);
                        if (!IsListed(slab, number, slot))
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

    /// <summary>Whether a body is in a cell already: what is healed is listed again where it was.</summary>
    private static bool IsListed(CellTable<int> slab, ulong number, int slot)
    {
        int entry = slab.First(number);
        while (entry != CellTable<int>.None && (slab.Value(entry) != slot || slab.Cell(entry) != number))
        {
            entry = slab.Next(entry);
        }

        return entry != CellTable<int>.None;
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
        SimTime last = slabs.End ?? from;
        bool isStill = IsStill(path);
        for (SimTime at = from; ;)
        {
            SimTime next = SimTime.Min(SimTime.Min(until, last), SlabRing.EndOf(SlabRing.NumberOf(at)));
            next = SimTime.Max(next, at);
            bool isLast = next >= until || next >= last;
            CellBlock cells = grid.Around(path, dense, at, next, around);
            if (cells.Count > MostCells)
            {
                FindAll();
                return;
            }

            CellTable<int>? slab = slabs.Find(SlabRing.NumberOf(at));
            CellTable<int>? ending = at == from ? slabs.Find(SlabRing.NumberOf(at - SimDuration.OneTick)) : null; // who is listed to this very instant, if a slab begins with it
            bool looksForStays = !isStill || at == from;
            for (long x = cells.X.From; x <= cells.X.To; x++)
            {
                for (long y = cells.Y.From; y <= cells.Y.To; y++)
                {
                    for (long z = cells.Z.From; z <= cells.Z.To; z++)
                    {
                        ulong number = grid.Number(x, y, z);
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

    private static SimTime Later(SimTime from, double seconds) =>
        TickConversion.TryFromSeconds(seconds, out long ticks) && ticks < SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(Math.Max(1, ticks))
            : SimTime.MaxValue;

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
