using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>
/// The shells that bodies have left, by time and place, back to the edge of the history. Heals use them to find where bodies were.
/// </summary>
internal sealed class PastShells
{
    private readonly SlabRing slabs = new();
    private readonly CellGrid grid;
    private readonly PeriodicBox box;
    private readonly double widestInCells;

    /// <summary>No body yet; of the same cells as the <see cref="PresentShells"/>.</summary>
    internal PastShells(CellGrid grid, in PeriodicBox box, double widestInCells)
    {
        this.grid = grid;
        this.box = box;
        this.widestInCells = widestInCells;
    }

    /// <summary>A body was in a shell, listed in that cell, from a time on until another.</summary>
    internal void Add(ulong cell, int slot, in Shell shell, SimTime from, SimTime until) =>
        slabs.Get(SlabRing.NumberOf(until)).Add(cell, new Stay(slot, shell, from, until));

    /// <summary>
    /// The same for a body in a heal, which as a rule is where it was before: one entry covers both, if it can, so that repeated heals do
    /// not fill the cells.
    /// </summary>
    internal void AddAgain(ulong cell, int slot, in Shell shell, SimTime from, SimTime until)
    {
        CellTable<Stay> slab = slabs.Get(SlabRing.NumberOf(until));
        for (int entry = cell == PresentShells.Wide ? CellTable<Stay>.None : slab.First(cell); entry != CellTable<Stay>.None; entry = slab.Next(entry))
        {
            ref readonly Stay before = ref slab.Value(entry);
            if (slab.Cell(entry) == cell && before.Slot == slot)
            {
                Shell both = before.Shell.Around(shell);
                if (both.Extent <= widestInCells)
                {
                    slab.Replace(entry, new Stay(slot, both, SimTime.Min(from, before.From), SimTime.Max(until, before.Until)));
                    return;
                }
            }
        }

        slab.Add(cell, new Stay(slot, shell, from, until));
    }

    /// <summary>Nothing before that time will be asked for again.</summary>
    internal void DropBefore(SimTime edge) => slabs.DropBefore(edge);

    /// <summary>Finds whose shells came within a distance of another shell at any time of a span.</summary>
    internal void Look(in Shell shell, double near, SimTime from, SimTime until, SlotSet found)
    {
        CellBlock block = grid.Around(shell.Centre, shell.Extent + near + widestInCells);
        long first = slabs.From(SlabRing.NumberOf(from), out int count);
        for (int i = 0; i < count; i++)
        {
            if (slabs.Find(first + i) is not { } slab)
            {
                continue;
            }

            if (block.Count > PresentShells.MaxCells)
            {
                for (int entry = 0; entry < slab.Count; entry++)
                {
                    FindIfNear(slab.Value(entry), shell, near, from, until, found);
                }

                continue;
            }

            LookIn(slab, PresentShells.Wide, shell, near, from, until, found);
            for (long x = block.X.From; x <= block.X.To; x++)
            {
                for (long y = block.Y.From; y <= block.Y.To; y++)
                {
                    for (long z = block.Z.From; z <= block.Z.To; z++)
                    {
                        LookIn(slab, grid.Number(x, y, z), shell, near, from, until, found);
                    }
                }
            }
        }
    }

    private void LookIn(CellTable<Stay> slab, ulong number, in Shell shell, double near, SimTime from, SimTime until, SlotSet found)
    {
        for (int entry = slab.First(number); entry != CellTable<Stay>.None; entry = slab.Next(entry))
        {
            if (slab.Cell(entry) == number)
            {
                FindIfNear(slab.Value(entry), shell, near, from, until, found);
            }
        }
    }

    private void FindIfNear(in Stay stay, in Shell shell, double near, SimTime from, SimTime until, SlotSet found)
    {
        double reach = shell.Extent + stay.Shell.Extent + near;
        if (stay.Until >= from && stay.From <= until && !(box.Nearest(stay.Shell.Centre - shell.Centre).LengthSquared > reach * reach))
        {
            found.Add(stay.Slot);
        }
    }

    /// <summary>When which body was in which shell.</summary>
    internal readonly struct Stay
    {
        internal Stay(int slot, in Shell shell, SimTime from, SimTime until)
        {
            Slot = slot;
            Shell = shell;
            From = from;
            Until = until;
        }

        internal int Slot { get; }

        internal Shell Shell { get; }

        internal SimTime From { get; }

        internal SimTime Until { get; }
    }
}
