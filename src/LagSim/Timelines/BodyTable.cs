using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>The bodies that a world knows, including absent ones: the slot and spec of each, and their canonical order.</summary>
/// <remarks>
/// A body keeps its slot until it is forgotten; then another may get it. No slot enters an order or a hash. Not thread-safe.
/// </remarks>
internal sealed class BodyTable
{
    /// <summary>The least number of bodies that there is room for. The room grows unless a quarter is free.</summary>
    private const int FewestSlots = 4;

    private readonly List<int> order; // slots by ascending identity
    private readonly Stack<int> free = new();
    private Body[] bodies;

    /// <summary>None yet; with room for as many as are expected.</summary>
    internal BodyTable(int expected)
    {
        bodies = new Body[Math.Max(FewestSlots, expected)];
        order = new List<int>(expected);
    }

    /// <summary>How many there are.</summary>
    internal int Count => order.Count;

    /// <summary>All slots that were ever given are below this.</summary>
    internal int SlotCount { get; private set; }

    /// <summary>The number of bodies that there is room for without more memory.</summary>
    internal int Room => bodies.Length;

    /// <summary>Whether another body needs more memory, or one that is forgotten first.</summary>
    internal bool IsFull => free.Count == 0 && SlotCount == bodies.Length;

    /// <summary>A number that changes whenever a body is added or forgotten: keepers of a list of bodies compare it.</summary>
    internal long Version { get; private set; }

    internal BodyId Id(int slot) => bodies[slot].Id;

    /// <summary>The spec of a body; the default if only its name is known.</summary>
    internal ref readonly BodySpec Spec(int slot) => ref bodies[slot].Spec;

    internal void SetSpec(int slot, in BodySpec spec) => bodies[slot].Spec = spec;

    /// <summary>Which peers may do something to a spawned body; everyone for one of the scene, whose rights the host knows.</summary>
    internal PeerSet Players(int slot) => bodies[slot].Players;

    internal void SetPlayers(int slot, PeerSet players) => bodies[slot].Players = players;

    /// <summary>The slots in canonical order of their bodies.</summary>
    public List<int>.Enumerator GetEnumerator() => order.GetEnumerator();

    /// <summary>The slot of the n-th body in canonical order.</summary>
    internal int SlotAt(int n) => order[n];

    /// <summary>The slot of a body, or -1 if it is not known.</summary>
    internal int SlotOf(BodyId id)
    {
        int at = Find(id);
        return at < 0 ? -1 : order[at];
    }

    /// <summary>Adds a body that is not known, and returns its slot.</summary>
    internal int Add(BodyId id, in BodySpec spec)
    {
        if (IsFull)
        {
            Array.Resize(ref bodies, bodies.Length * 2);
        }

        int slot = free.Count > 0 ? free.Pop() : SlotCount++;
        bodies[slot] = new Body { Id = id, Spec = spec };
        order.Insert(~Find(id), slot);
        Version++;
        return slot;
    }

    /// <summary>
    /// Forgets all bodies that are gone, and makes more room if few slots become free. Otherwise every other added body would cause a
    /// search through all of them.
    /// </summary>
    /// <param name="isGone">Asked for each slot, in canonical order, and only once.</param>
    internal void Forget(Predicate<int> isGone)
    {
        order.RemoveAll(slot =>
        {
            bool goes = isGone(slot);
            if (goes)
            {
                free.Push(slot);
                Version++;
            }

            return goes;
        });
        if (free.Count < bodies.Length / 4)
        {
            Array.Resize(ref bodies, bodies.Length * 2);
        }
    }

    /// <summary>The place of an identity in the order, or the complement of where it belongs.</summary>
    private int Find(BodyId id)
    {
        int low = 0;
        int high = order.Count - 1;
        while (low <= high)
        {
            int middle = (low + high) >> 1;
            int compared = bodies[order[middle]].Id.CompareTo(id);
            if (compared == 0)
            {
                return middle;
            }

            if (compared < 0)
            {
                low = middle + 1;
            }
            else
            {
                high = middle - 1;
            }
        }

        return ~low;
    }

    private struct Body
    {
        internal BodyId Id;
        internal BodySpec Spec;
        internal PeerSet Players;
    }
}
