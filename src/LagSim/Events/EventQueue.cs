using System;

namespace LagSim.Events;

/// <summary>The pending events of a world: at most one a body, by construction, popped in canonical order.</summary>
/// <remarks>
/// <para>A heap with four children a node over (key, slot), with the position of every slot kept, so that a body's event is replaced or
/// taken out in place. Two bodies that wait for the same impact have equal keys; which slot comes first does not matter, for the impact
/// settles both.</para>
/// <para>Cost: O(log n) for <see cref="Set"/> and <see cref="Remove"/>, O(1) for the least. Allocates only when a new slot does not fit.</para>
/// </remarks>
internal sealed class EventQueue
{
    private const int Children = 4;
    private const int NotQueued = -1;

    private EventKey[] keys = new EventKey[16];
    private int[] slots = new int[16];
    private int[] positions = Array.Empty<int>();

    internal int Count { get; private set; }

    /// <summary>The slot whose event is the least.</summary>
    internal int LeastSlot => Count > 0 ? slots[0] : throw new InvalidOperationException("No event is pending.");

    /// <summary>The least pending key.</summary>
    internal ref readonly EventKey LeastKey
    {
        get
        {
            if (Count == 0)
            {
                throw new InvalidOperationException("No event is pending.");
            }

            return ref keys[0];
        }
    }

    /// <summary>True and the key of the slot's pending event, if it has one.</summary>
    internal bool TryGet(int slot, out EventKey key)
    {
        int at = slot < positions.Length ? positions[slot] : NotQueued;
        key = at == NotQueued ? default : keys[at];
        return at != NotQueued;
    }

    /// <summary>Makes this the slot's one pending event, in place of any other.</summary>
    internal void Set(int slot, in EventKey key)
    {
        if (slot >= positions.Length)
        {
            int old = positions.Length;
            Array.Resize(ref positions, Math.Max(slot + 1, Math.Max(16, old * 2)));
            positions.AsSpan(old).Fill(NotQueued);
        }

        int at = positions[slot];
        if (at == NotQueued)
        {
            if (Count == keys.Length)
            {
                Array.Resize(ref keys, Count * 2);
                Array.Resize(ref slots, Count * 2);
            }

            Rise(Count++, slot, key);
        }
        else if (EventKey.Compare(key, keys[at]) < 0)
        {
            Rise(at, slot, key);
        }
        else
        {
            Sink(at, slot, key);
        }
    }

    /// <summary>Takes the slot's pending event out, if it has one.</summary>
    internal void Remove(int slot)
    {
        int at = slot < positions.Length ? positions[slot] : NotQueued;
        if (at == NotQueued)
        {
            return;
        }

        positions[slot] = NotQueued;
        Count--;
        if (at == Count)
        {
            return;
        }

        EventKey moved = keys[Count];
        int movedSlot = slots[Count];
        if (at > 0 && EventKey.Compare(moved, keys[(at - 1) / Children]) < 0)
        {
            Rise(at, movedSlot, moved);
        }
        else
        {
            Sink(at, movedSlot, moved);
        }
    }

    private void Rise(int at, int slot, in EventKey key)
    {
        while (at > 0)
        {
            int parent = (at - 1) / Children;
            if (EventKey.Compare(key, keys[parent]) >= 0)
            {
                break;
            }

            Put(at, slots[parent], keys[parent]);
            at = parent;
        }

        Put(at, slot, key);
    }

    private void Sink(int at, int slot, in EventKey key)
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
                if (EventKey.Compare(keys[i], keys[least]) < 0)
                {
                    least = i;
                }
            }

            if (EventKey.Compare(key, keys[least]) <= 0)
            {
                break;
            }

            Put(at, slots[least], keys[least]);
            at = least;
        }

        Put(at, slot, key);
    }

    private void Put(int at, int slot, in EventKey key)
    {
        keys[at] = key;
        slots[at] = slot;
        positions[slot] = at;
    }
}
