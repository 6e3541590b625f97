using System;

namespace LagSim.Contacts;

/// <summary>A list of slots for every slot, all in one array: blocks of a power of two, and those that became too small are used again.</summary>
/// <remarks>Cost: O(1) to add where the caller knows that it is not there, O(length) to take out. Allocates only when more is listed than ever before.</remarks>
internal sealed class NeighbourLists
{
    private const int None = -1;
    private const int SmallestBits = 3; // 8 slots

    private readonly int[] free = new int[32]; // by bits of the size: a block that nobody has, whose first place names the next
    private int[] pool = new int[1024];
    private int used;
    private Block[] blocks = new Block[16];

    internal NeighbourLists() => Array.Fill(free, None);

    /// <summary>Makes room for a slot.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= blocks.Length)
        {
            Array.Resize(ref blocks, Math.Max(slot + 1, blocks.Length * 2));
        }
    }

    /// <summary>What is listed of a slot. Valid until anything is added.</summary>
    internal Span<int> Of(int slot)
    {
        ref Block block = ref blocks[slot];
        return pool.AsSpan(block.From, block.Count);
    }

    /// <summary>Empties a slot's list; it keeps its block.</summary>
    internal void Clear(int slot) => blocks[slot].Count = 0;

    /// <summary>Adds another, that the caller knows is not there.</summary>
    internal void Add(int slot, int other)
    {
        ref Block block = ref blocks[slot];
        if (block.Count == block.Size)
        {
            Grow(ref block);
        }

        pool[block.From + block.Count++] = other;
    }

    /// <summary>Adds another if it is not there.</summary>
    internal void AddOnce(int slot, int other)
    {
        if (Of(slot).IndexOf(other) < 0)
        {
            Add(slot, other);
        }
    }

    /// <summary>Takes another out, if it is there.</summary>
    internal void Remove(int slot, int other)
    {
        Span<int> list = Of(slot);
        int at = list.IndexOf(other);
        if (at >= 0)
        {
            list[at] = list[list.Length - 1];
            blocks[slot].Count--;
        }
    }

    private void Grow(ref Block block)
    {
        int bits = block.Size == 0 ? SmallestBits : block.Bits + 1;
        int from = free[bits];
        if (from != None)
        {
            free[bits] = pool[from];
        }
        else
        {
            from = used;
            used += 1 << bits;
            if (used > pool.Length)
            {
                Array.Resize(ref pool, Math.Max(used, pool.Length + (pool.Length / 2)));
            }
        }

        Array.Copy(pool, block.From, pool, from, block.Count);
        if (block.Size > 0)
        {
            pool[block.From] = free[block.Bits];
            free[block.Bits] = block.From;
        }

        block.From = from;
        block.Bits = bits;
        block.Size = 1 << bits;
    }

    private struct Block
    {
        internal int From;
        internal int Count;
        internal int Size;
        internal int Bits;
    }
}
