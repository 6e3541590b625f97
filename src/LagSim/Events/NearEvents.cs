using System;

namespace LagSim.Events;

/// <summary>
/// The next events of an <see cref="EventQueue"/>, as a heap with four children a node. The heap holds times; keys are read only where
/// times are equal.
/// </summary>
internal sealed class NearEvents
{
    private const int Children = 4;

    private Item[] items;

    /// <summary>No events yet; with room for that many at first, at least one.</summary>
    internal NearEvents(int room) => items = new Item[room];

    internal int Count { get; private set; }

    internal int MinSlot => items[0].Slot;

    /// <summary>Whether all others but one slot's come at a later time than the least.</summary>
    internal bool AreTheOnlyLeast(int other)
    {
        long ticks = items[0].Ticks;
        int at = 0;
        for (int i = 1; i <= Children && i < Count; i++)
        {
            if (items[i].Ticks == ticks)
            {
                if (items[i].Slot != other)
                {
                    return false;
                }

                at = i;
            }
        }

        bool isAlone = true;
        int below = (at * Children) + 1;
        for (int i = below; at > 0 && i < below + Children && i < Count; i++)
        {
            isAlone &= items[i].Ticks > ticks;
        }

        return isAlone;
    }

    internal void Clear() => Count = 0;

    internal void Add(EventQueue.Node[] nodes, int slot)
    {
        if (Count == items.Length)
        {
            Array.Resize(ref items, Count * 2);
        }

        Rise(nodes, Count++, new Item(nodes[slot].Key.Time.Ticks, slot));
    }

    internal void Remove(EventQueue.Node[] nodes, int slot)
    {
        int at = nodes[slot].Where;
        Count--;
        if (at < Count)
        {
            Settle(nodes, at, items[Count]);
        }
    }

    /// <summary>The slot's event has another key now.</summary>
    internal void Moved(EventQueue.Node[] nodes, int slot) => Settle(nodes, nodes[slot].Where, new Item(nodes[slot].Key.Time.Ticks, slot));

    private static bool IsBefore(EventQueue.Node[] nodes, in Item a, in Item b) =>
        a.Ticks < b.Ticks || (a.Ticks == b.Ticks && EventKey.Compare(nodes[a.Slot].Key, nodes[b.Slot].Key) < 0);

    private void Settle(EventQueue.Node[] nodes, int at, in Item item)
    {
        if (at > 0 && IsBefore(nodes, item, items[(at - 1) / Children]))
        {
            Rise(nodes, at, item);
        }
        else
        {
            Sink(nodes, at, item);
        }
    }

    private void Rise(EventQueue.Node[] nodes, int at, in Item item)
    {
        while (at > 0)
        {
            int parent = (at - 1) / Children;
            if (!IsBefore(nodes, item, items[parent]))
            {
                break;
            }

            Put(nodes, at, items[parent]);
            at = parent;
        }

        Put(nodes, at, item);
    }

    private void Sink(EventQueue.Node[] nodes, int at, in Item item)
    {
        while (true)
        {
            int child = (at * Children) + 1;
            if (child >= Count)
            {
                break;
            }

            int least = child;
            int end = Math.Min(child + Children, Count);
            for (int i = child + 1; i < end; i++)
            {
                least = IsBefore(nodes, items[i], items[least]) ? i : least;
            }

            if (!IsBefore(nodes, items[least], item))
            {
                break;
            }

            Put(nodes, at, items[least]);
            at = least;
        }

        Put(nodes, at, item);
    }

    private void Put(EventQueue.Node[] nodes, int at, in Item item)
    {
        items[at] = item;
        nodes[item.Slot].Where = at;
    }

    private readonly struct Item
    {
        internal Item(long ticks, int slot)
        {
            Ticks = ticks;
            Slot = slot;
        }

        internal long Ticks { get; }

        internal int Slot { get; }
    }
}
