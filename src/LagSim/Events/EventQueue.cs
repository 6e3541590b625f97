using System;

namespace LagSim.Events;

/// <summary>The pending events of a world: at most one a body, by construction, popped in canonical order.</summary>
/// <remarks>
/// <para>A calendar (Paul 2007, physics/0606226): time is cut into slices, each with a list of its events in no order. Events of the
/// current slice, and all before it, are in a heap (<see cref="NearEvents"/>); events beyond the last slice are in a list of their own. So
/// an event is added, replaced and removed in O(1), apart from the few of the current slice. The queue adapts the length of slices so that
/// each holds a few events; few events are all in the heap. Where an event is kept has no influence on the order.</para>
/// <para>Two bodies that wait for the same impact have equal keys. Which slot comes first does not matter, because the impact handles
/// both.</para>
/// <para>Cost: O(1), amortised, unless all happens at one tick: then O(log n). Allocates only when more is pending than ever before.</para>
/// </remarks>
internal sealed class EventQueue
{
    /// <summary>The number of events that a slice should hold.</summary>
    private const int PerSlice = 4;

    /// <summary>Up to so many events are all in the heap; and so many there are too many, if they need not be.</summary>
    private const int Few = 64;

    private const int MaxSamples = 256;
    private const int None = -1;

    /// <summary>From this value on <see cref="Node.Where"/> is a place in the heap.</summary>
    private const int Near = 0;

    private const int NotQueued = -1;
    private const int InSlice = -2;
    private const int Beyond = -3;

    private readonly NearEvents near;
    private long[] samples = Array.Empty<long>(); // only once slices are made
    private Node[] nodes; // by slot
    private int[] slices = Array.Empty<int>(); // a ring, made once events are many: the first slot of each slice from the current one on
    private int inSlices;
    private int beyond = None;
    private int inBeyond;
    private int shift; // a slice is 2^shift ticks
    private long current = long.MaxValue; // the current slice; the last there is while events are few
    private long swept; // the current slice when the events beyond the last one were last tested
    private long taken; // how many events were taken out of slices since
    private long changes; // since the slices were made

    /// <summary>Nothing pending yet; with room for as many bodies as are expected at first.</summary>
    internal EventQueue(int expected = 0)
    {
        near = new NearEvents(Math.Max(4, Math.Min(expected, 2 * Few)));
        nodes = new Node[expected];
        Array.Fill(nodes, new Node { Where = NotQueued });
    }

    internal int Count => near.Count + inSlices + inBeyond;

    /// <summary>The slot of the least event.</summary>
    internal int MinSlot
    {
        get
        {
            Advance();
            return near.MinSlot;
        }
    }

    /// <summary>The least pending key.</summary>
    internal ref readonly EventKey MinKey
    {
        get
        {
            Advance();
            return ref nodes[near.MinSlot].Key;
        }
    }

    /// <summary>True, with the slot of the least event and its key; false if none is pending.</summary>
    internal bool TryGetLeast(out int slot, out EventKey key)
    {
        if (Count == 0)
        {
            (slot, key) = (None, default);
            return false;
        }

        slot = MinSlot;
        key = nodes[slot].Key;
        return true;
    }

    /// <summary>True and the key of the slot's pending event, if it has one.</summary>
    internal bool TryGet(int slot, out EventKey key)
    {
        bool isQueued = slot < nodes.Length && nodes[slot].Where != NotQueued;
        key = isQueued ? nodes[slot].Key : default;
        return isQueued;
    }

    /// <summary>
    /// Whether nothing is pending up to and including the time of the least key but that, of one slot and of another that waits for the
    /// same.
    /// </summary>
    internal bool AreTheOnlyLeast(int other, in EventKey least) =>
        other < nodes.Length && nodes[other].Where >= Near && nodes[other].Key == least && near.AreTheOnlyLeast(other);

    /// <summary>Makes this the slot's one pending event, in place of any other.</summary>
    internal void Set(int slot, in EventKey key)
    {
        if (slot >= nodes.Length)
        {
            int old = nodes.Length;
            Array.Resize(ref nodes, Math.Max(slot + 1, Math.Max(16, old * 2)));
            nodes.AsSpan(old).Fill(new Node { Where = NotQueued });
        }

        ref Node node = ref nodes[slot];
        if (node.Where >= Near)
        {
            if (IsNear(key.Time.Ticks))
            {
                node.Key = key;
                near.Moved(nodes, slot);
                return;
            }

            near.Remove(nodes, slot);
        }
        else if (node.Where != NotQueued)
        {
            Unlink(ref node);
        }

        node.Key = key;
        Put(slot, ref node);
        changes++;
        if (near.Count > Few && (current == long.MaxValue || (shift > 0 && changes > Count)))
        {
            Arrange();
        }
    }

    /// <summary>Takes the slot's pending event out, if it has one.</summary>
    internal void Remove(int slot)
    {
        if (slot >= nodes.Length || nodes[slot].Where == NotQueued)
        {
            return;
        }

        ref Node node = ref nodes[slot];
        if (node.Where >= Near)
        {
            near.Remove(nodes, slot);
        }
        else
        {
            Unlink(ref node);
        }

        node.Where = NotQueued;
        changes++;
    }

    private bool IsNear(long ticks) => ticks >> shift <= current;

    private void Put(int slot, ref Node node)
    {
        long slice = node.Key.Time.Ticks >> shift;
        if (slice <= current)
        {
            near.Add(nodes, slot);
        }
        else if ((ulong)slice - (ulong)current < (ulong)slices.Length)
        {
            Link(ref slices[slice & (slices.Length - 1)], slot, ref node, InSlice);
            inSlices++;
        }
        else
        {
            Link(ref beyond, slot, ref node, Beyond);
            inBeyond++;
        }
    }

    private void Link(ref int head, int slot, ref Node node, int where)
    {
        node.Where = where;
        node.Previous = None;
        node.Next = head;
        if (head != None)
        {
            nodes[head].Previous = slot;
        }

        head = slot;
    }

    private void Unlink(ref Node node)
    {
        if (node.Next != None)
        {
            nodes[node.Next].Previous = node.Previous;
        }

        if (node.Previous != None)
        {
            nodes[node.Previous].Next = node.Next;
        }
        else if (node.Where == InSlice)
        {
            slices[(node.Key.Time.Ticks >> shift) & (slices.Length - 1)] = node.Next;
        }
        else
        {
            beyond = node.Next;
        }

        inSlices -= node.Where == InSlice ? 1 : 0;
        inBeyond -= node.Where == Beyond ? 1 : 0;
    }

    /// <summary>Moves to the next slice that is not empty, if the current one is.</summary>
    private void Advance()
    {
        while (near.Count == 0)
        {
            if (inSlices == 0)
            {
                if (inBeyond == 0)
                {
                    throw new InvalidOperationException("No event is pending.");
                }

                Arrange();
                continue;
            }

            current++;
            ref int head = ref slices[current & (slices.Length - 1)];
            while (head != None)
            {
                int slot = head;
                head = nodes[slot].Next;
                near.Add(nodes, slot);
                inSlices--;
                taken++;
            }

            if (current - swept >= slices.Length / 2)
            {
                Sweep();
            }
        }
    }

    /// <summary>Takes over what no longer lies beyond the slices; and makes other slices if these hold too many or too few.</summary>
    private void Sweep()
    {
        long passed = current - swept;
        bool fits = taken <= 4 * PerSlice * passed && 4 * taken >= PerSlice * passed;
        if (!fits && changes > Count)
        {
            Arrange();
            return;
        }

        swept = current;
        taken = 0;
        for (int slot = beyond; slot != None;)
        {
            ref Node node = ref nodes[slot];
            int next = node.Next;
            if ((ulong)(node.Key.Time.Ticks >> shift) - (ulong)current < (ulong)slices.Length)
            {
                Unlink(ref node);
                Put(slot, ref node);
            }

            slot = next;
        }
    }

    /// <summary>Makes the slices again for the events that are pending now.</summary>
    private void Arrange()
    {
        int count = Count;
        long least = Least(out int sampled);
        near.Clear();
        beyond = None;
        inSlices = 0;
        inBeyond = 0;
        changes = 0;
        taken = 0;
        int size = Math.Max(slices.Length, 2 * Few / PerSlice);
        while (size * PerSlice < 2 * count)
        {
            size *= 2;
        }

        slices = size == slices.Length ? slices : new int[size];
        Array.Fill(slices, None);
        shift = 0;
        current = long.MaxValue;
        if (count > Few / 2)
        {
            // An eighth of the pending events shows how dense events are from here on, whatever the rest waits for.
            Array.Sort(samples, 0, sampled);
            ulong eighth = (ulong)samples[sampled / 8] - (ulong)least;
            ulong length = Math.Min(eighth / ((ulong)count / 8), long.MaxValue / PerSlice) * PerSlice;
            while (length >> (shift + 1) > 0)
            {
                shift++;
            }

            current = least >> shift;
        }

        swept = current;
        for (int slot = 0; slot < nodes.Length; slot++)
        {
            if (nodes[slot].Where != NotQueued)
            {
                Put(slot, ref nodes[slot]);
            }
        }
    }

    /// <summary>The earliest time that anything is pending for; and some of all times, as samples.</summary>
    private long Least(out int sampled)
    {
        long least = long.MaxValue;
        int every = Math.Max(1, (Count + MaxSamples - 1) / MaxSamples);
        int seen = 0;
        samples = samples.Length > 0 ? samples : new long[MaxSamples];
        sampled = 0;
        for (int slot = 0; slot < nodes.Length; slot++)
        {
            if (nodes[slot].Where == NotQueued)
            {
                continue;
            }

            long ticks = nodes[slot].Key.Time.Ticks;
            least = Math.Min(least, ticks);
            if (seen++ % every == 0)
            {
                samples[sampled++] = ticks;
            }
        }

        return least;
    }

    /// <summary>A slot's pending event, and where it is kept.</summary>
    internal struct Node
    {
        internal EventKey Key;
        internal int Next;
        internal int Previous;
        internal int Where;
    }
}
