using System;

namespace LagSim.BroadPhase;

/// <summary>Many short lists in one array: blocks of a power of two, which are reused when their list outgrows them.</summary>
/// <typeparam name="T">The type of the values.</typeparam>
/// <remarks>Cost: O(1) to add and to remove at a place. Allocates only when more is listed than ever before.</remarks>
internal sealed class PooledLists<T>
    where T : struct
{
    private const int None = -1;
    private const int SmallestBits = 2;

    private readonly int[] free = new int[32]; // by bits of the size: a block that no list has
    private T[] pool;
    private int[] nextFree; // by place of a free block: the next of that size
    private int used;
    private Block[] blocks;

    /// <summary>That many empty lists, with room for that many values in all of them at first.</summary>
    internal PooledLists(int count, int room = 256)
    {
        blocks = new Block[count];
        pool = new T[room];
        nextFree = new int[(room >> SmallestBits) + 1];
        Array.Fill(free, None);
    }

    /// <summary>How many lists there are.</summary>
    internal int Count => blocks.Length;

    /// <summary>Makes room for more lists.</summary>
    internal void Grow(int count) => Array.Resize(ref blocks, count);

    /// <summary>The values of a list. Valid until anything is added anywhere.</summary>
    internal Span<T> Of(int list)
    {
        ref Block block = ref blocks[list];
        return pool.AsSpan(block.From, block.Count);
    }

    /// <summary>Empties a list; it keeps its block.</summary>
    internal void Clear(int list) => blocks[list].Count = 0;

    internal void Add(int list, in T value)
    {
        ref Block block = ref blocks[list];
        if (block.Count == block.Size)
        {
            Widen(ref block);
        }

        pool[block.From + block.Count++] = value;
    }

    /// <summary>Takes out what is at a place of a list; the last takes the place.</summary>
    internal void RemoveAt(int list, int at)
    {
        ref Block block = ref blocks[list];
        pool[block.From + at] = pool[block.From + --block.Count];
    }

    private void Widen(ref Block block)
    {
        int bits = block.Size == 0 ? SmallestBits : block.Bits + 1;
        int from = free[bits];
        if (from != None)
        {
            free[bits] = nextFree[from >> SmallestBits];
        }
        else
        {
            from = used;
            used += 1 << bits;
            if (used > pool.Length)
            {
                int size = Math.Max(used, pool.Length + (pool.Length / 2));
                Array.Resize(ref pool, size);
                Array.Resize(ref nextFree, (size >> SmallestBits) + 1);
            }
        }

        Array.Copy(pool, block.From, pool, from, block.Count);
        if (block.Size > 0)
        {
            nextFree[block.From >> SmallestBits] = free[block.Bits];
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
