using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>The shells that bodies have left, by when and where, back to the edge of the history: who was where, for what is healed.</summary>
internal sealed class PastShells
{
    /// <summary>The cell of what is too wide for any; no place has this number but by chance, and then it is looked at twice.</summary>
    internal const ulong Wide = ulong.MaxValue;

    private readonly SlabRing slabs = new();

    /// <summary>A body was in a shell from a time on until another.</summary>
    internal void Add(ulong cell, int slot, in Shell shell, SimTime from, SimTime until) =>
        slabs.Get(SlabRing.NumberOf(until)).Add(cell, new Stay(slot, shell, from, until));

    /// <summary>What lies before that time is asked for no more.</summary>
    internal void DropBefore(SimTime edge) => slabs.DropBefore(edge);

    /// <summary>The first slab with shells that were left at a time or later, and how many slabs there are from it on.</summary>
    internal long SlabsFrom(SimTime time, out int count) => slabs.From(SlabRing.NumberOf(time), out count);

    /// <summary>What is listed in a slab; null if nothing is.</summary>
    internal CellTable<Stay>? Slab(long number) => slabs.Find(number);

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
