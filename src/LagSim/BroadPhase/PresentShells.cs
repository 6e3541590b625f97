using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.BroadPhase;

/// <summary>
/// The shells that bodies are in now, by the cells that their centres are in; those that are too wide for the cells apart.
/// </summary>
internal sealed class PresentShells
{
    /// <summary>The cell of what is too wide for any; no place has this number.</summary>
    internal const ulong Wide = ulong.MaxValue;

    /// <summary>The number of cells beyond which a search tests all bodies instead.</summary>
    internal const double MaxCells = 512;

    private const int FewestLists = 64;

    private readonly CellGrid grid;
    private readonly PeriodicBox box;
    private readonly Vector3D sides; // of the box; endless without one, so that no image is nearer
    private readonly double widestInCells;
    private readonly List<Entry> wide = new();
    private PooledLists<Entry> cells; // by the cell's number, hashed
    private int listed;
    private double widest; // extent of what has been in cells

    /// <summary>No body yet.</summary>
    /// <param name="grid">The cells.</param>
    /// <param name="box">The periodic box; empty if there is none.</param>
    /// <param name="widestInCells">The extent, in metres, above which a shell is in no cell.</param>
    /// <param name="expected">The number of bodies that there are lists for at first.</param>
    internal PresentShells(CellGrid grid, in PeriodicBox box, double widestInCells, int expected)
    {
        int lists = FewestLists;
        while (lists < expected)
        {
            lists *= 2;
        }

        // Of two in three lists, the smallest of which have room for four.
        cells = new PooledLists<Entry>(lists, Math.Max(lists, 2 * expected));
        this.grid = grid;
        this.box = box;
        sides = box.Exists ? box.Size : new Vector3D(double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity);
        this.widestInCells = widestInCells;
    }

    /// <summary>How many are in no cell.</summary>
    internal int WideCount => wide.Count;

    /// <summary>The cell that a shell is listed in.</summary>
    internal ulong CellOf(in Shell shell) => shell.Extent > widestInCells ? Wide : grid.NumberAt(shell.Centre);

    /// <summary>A body is in a shell from now on.</summary>
    internal void Add(int slot, in Shell shell, ulong cell)
    {
        Entry entry = new(slot, box.Wrap(shell.Centre), shell.Extent, cell);
        if (cell == Wide)
        {
            wide.Add(entry);
            return;
        }

        widest = Math.Max(widest, shell.Extent);
        if (++listed > cells.Count)
        {
            Spread();
        }

        cells.Add(Bucket(cell), entry);
    }

    /// <summary>A body has left the shell that was listed in a cell.</summary>
    internal void Remove(int slot, ulong cell)
    {
        if (cell == Wide)
        {
            int last = wide.Count - 1;
            int hole = last;
            while (wide[hole].Slot != slot)
            {
                hole--;
            }

            wide[hole] = wide[last];
            wide.RemoveAt(last);
            return;
        }

        int bucket = Bucket(cell);
        Span<Entry> entries = cells.Of(bucket);
        int at = 0;
        while (entries[at].Slot != slot)
        {
            at++;
        }

        cells.RemoveAt(bucket, at);
        listed--;
    }

    /// <summary>Finds whose shells come within a distance of another shell; all of them are new to <paramref name="found"/>.</summary>
    internal void Look(in Shell shell, double near, SlotSet found)
    {
        Vector3D place = box.Wrap(shell.Centre);
        double reach = shell.Extent + near;
        found.Reserve(wide.Count + 1);
        foreach (Entry entry in wide)
        {
            found.AddIf(entry.IsWithin(place.X, place.Y, place.Z, reach, sides), entry.Slot);
        }

        CellBlock block = grid.Around(shell.Centre, reach + widest);
        if (block.Count > MaxCells)
        {
            for (int bucket = 0; bucket < cells.Count; bucket++)
            {
                LookAround(cells.Of(bucket), 0, 0, place, reach, found);
            }

            return;
        }

        bool isInside = IsInside(place, (reach + widest) * (1 + 1e-9));
        for (long k = block.Z.From; k <= block.Z.To; k++)
        {
            for (long j = block.Y.From; j <= block.Y.To; j++)
            {
                for (long i = block.X.From; i <= block.X.To; i++)
                {
                    ulong number = grid.Number(i, j, k);
                    Span<Entry> entries = cells.Of(Bucket(number));
                    if (isInside)
                    {
                        LookIn(entries, number, place, reach, found);
                    }
                    else
                    {
                        LookAround(entries, number, ulong.MaxValue, place, reach, found);
                    }
                }
            }
        }
    }

    /// <summary>
    /// Whether a place in the box is so far from all its sides that everything within that distance is reached without crossing a side.
    /// </summary>
    private bool IsInside(in Vector3D place, double far) =>
        !box.Exists || (place.X > far && place.X < sides.X - far && place.Y > far && place.Y < sides.Y - far && place.Z > far && place.Z < sides.Z - far);

    /// <summary>
    /// The same among the entries of one list that belong to a cell, by the straight way. Whether one is found is not a branch, because it
    /// cannot be predicted; the count is kept in a register.
    /// </summary>
    private static void LookIn(Span<Entry> entries, ulong cell, in Vector3D place, double reach, SlotSet found)
    {
        Span<int> into = found.Room(entries.Length + 1);
        double x = place.X, y = place.Y, z = place.Z;
        int count = 0;
        foreach (ref Entry entry in entries)
        {
            into[count] = entry.Slot;
            int isHere = entry.Cell == cell ? 1 : 0;
            int isNear = entry.IsWithin(x, y, z, reach) ? 1 : 0;
            count += isHere & isNear;
        }

        found.Took(count);
    }

    /// <summary>The same by the shortest way, of those whose cell's number is a certain one where the mask has ones.</summary>
    private void LookAround(Span<Entry> entries, ulong cell, ulong mask, in Vector3D place, double reach, SlotSet found)
    {
        Span<int> into = found.Room(entries.Length + 1);
        double x = place.X, y = place.Y, z = place.Z;
        int count = 0;
        foreach (ref Entry entry in entries)
        {
            into[count] = entry.Slot;
            int isHere = ((entry.Cell ^ cell) & mask) == 0 ? 1 : 0;
            int isNear = entry.IsWithin(x, y, z, reach, sides) ? 1 : 0;
            count += isHere & isNear;
        }

        found.Took(count);
    }

    private int Bucket(ulong number) => CellGrid.Bucket(number, cells.Count);

    /// <summary>Doubles the lists, because there are more bodies than lists.</summary>
    private void Spread()
    {
        PooledLists<Entry> before = cells;
        cells = new PooledLists<Entry>(before.Count * 2, before.Count * 4);
        for (int bucket = 0; bucket < before.Count; bucket++)
        {
            foreach (ref Entry entry in before.Of(bucket))
            {
                cells.Add(Bucket(entry.Cell), entry);
            }
        }
    }

    /// <summary>The part of another body's shell that a search reads.</summary>
    private readonly struct Entry
    {
        private readonly double x;
        private readonly double y;
        private readonly double z;
        private readonly double extent;

        internal Entry(int slot, in Vector3D centre, double extent, ulong cell)
        {
            Slot = slot;
            Cell = cell;
            x = centre.X;
            y = centre.Y;
            z = centre.Z;
            this.extent = extent;
        }

        internal int Slot { get; }

        internal ulong Cell { get; }

        internal bool IsWithin(double fromX, double fromY, double fromZ, double reach)
        {
            double u = x - fromX, v = y - fromY, w = z - fromZ;
            double both = reach + extent;
            return !((u * u) + (v * v) + (w * w) > both * both);
        }

        /// <summary>
        /// Whether it comes so near to a place in the box, by whichever way is the shortest; without a branch for that either.
        /// </summary>
        internal bool IsWithin(double fromX, double fromY, double fromZ, double reach, in Vector3D sides)
        {
            double u = Math.Abs(x - fromX), v = Math.Abs(y - fromY), w = Math.Abs(z - fromZ);
            u = Math.Min(u, sides.X - u);
            v = Math.Min(v, sides.Y - v);
            w = Math.Min(w, sides.Z - w);
            double both = reach + extent;
            return !((u * u) + (v * v) + (w * w) > both * both);
        }
    }
}
