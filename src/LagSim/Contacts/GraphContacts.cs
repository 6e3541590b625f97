using System;

namespace LagSim.Contacts;

/// <summary>The contacts of a <see cref="ContactGraph"/>: sorted, looked up by their bodies, and listed by body.</summary>
/// <remarks>Cost: of sorting n log n, of looking up log n. Allocates only when there are more contacts than ever before.</remarks>
internal sealed class GraphContacts
{
    private readonly ContactLists lists = new();
    private ContactPoint[] contacts = new ContactPoint[1]; // as many as nearly all impacts have
    private long[] keys = new long[1]; // of contacts, as far as they are sorted
    private int sortedCount;

    internal int Count { get; private set; }

    internal Span<ContactPoint> All => contacts.AsSpan(0, Count);

    internal void Clear() => Count = sortedCount = 0;

    internal void Add(in ContactPoint contact)
    {
        if (Count == contacts.Length)
        {
            Array.Resize(ref contacts, Math.Max(8, Count * 2));
        }

        contacts[Count++] = contact;
    }

    /// <summary>Leaves out all from a number on.</summary>
    internal void Keep(int count)
    {
        Count = count;
        sortedCount = Math.Min(sortedCount, count);
    }

    /// <summary>Moves one to the place of one before it that is left out.</summary>
    internal void Move(int from, int to) => (contacts[to], keys[to]) = (contacts[from], keys[from]);

    /// <summary>Whether there is one of these: of two bodies the lesser first.</summary>
    internal bool Has(int first, int second, int surface)
    {
        long key = KeyOf(first, second, surface);
        bool has = sortedCount > 0 && Array.BinarySearch(keys, 0, sortedCount, key) >= 0;
        for (int i = sortedCount; i < Count && !has; i++)
        {
            has = KeyOf(contacts[i].First, contacts[i].Second, contacts[i].Surface) == key;
        }

        return has;
    }

    /// <summary>Sorts them by their bodies' numbers, surfaces before other bodies, and then by surface.</summary>
    internal void Sort()
    {
        if (keys.Length < Count)
        {
            keys = new long[contacts.Length];
        }

        bool isSorted = true;
        for (int i = 0; i < Count; i++)
        {
            keys[i] = KeyOf(contacts[i].First, contacts[i].Second, contacts[i].Surface);
            isSorted &= i == 0 || keys[i] > keys[i - 1];
        }

        if (!isSorted)
        {
            Array.Sort(keys, contacts, 0, Count);
        }

        sortedCount = Count;
    }

    /// <summary>Lists those of each body.</summary>
    internal void List(int bodyCount)
    {
        lists.Clear(bodyCount, Count);
        for (int i = 0; i < Count; i++)
        {
            lists.Count(contacts[i].First, contacts[i].Second);
        }

        lists.Sum();
        for (int i = Count - 1; i >= 0; i--)
        {
            lists.Put(i, contacts[i].First, contacts[i].Second);
        }
    }

    /// <summary>Those of a body, by number, as they were listed last.</summary>
    internal Span<int> ListOf(int body) => lists.Of(body);

    private static long KeyOf(int first, int second, int surface) =>
        ((long)first << 32) | (second == ContactPoint.Static ? (uint)surface : (uint)second | (1u << 31));
}
