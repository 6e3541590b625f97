using System;

namespace LagSim.Events;

/// <summary>The scheduled events: at most one a body, and the partner of each impact.</summary>
/// <remarks>
/// Cost: O(1), amortised (<see cref="EventQueue"/>). Allocates only when there are more bodies, or more is pending, than ever before.
/// </remarks>
internal sealed class EventScheduler(int expected)
{
    private readonly EventQueue queue = new(expected);
    private PendingContact[] contacts = new PendingContact[expected];

    /// <summary>How many events are pending.</summary>
    internal int Count => queue.Count;

    /// <summary>The slot of the least event.</summary>
    internal int MinSlot => queue.MinSlot;

    /// <summary>The least pending key.</summary>
    internal ref readonly EventKey MinKey => ref queue.MinKey;

    /// <summary>Makes room for a body, of which nothing is pending.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= contacts.Length)
        {
            Array.Resize(ref contacts, Math.Max(slot + 1, Math.Max(16, contacts.Length * 2)));
        }

        contacts[slot] = new PendingContact { Partner = PendingContact.NoPartner };
    }

    /// <summary>The partner of the body's pending event, if that is an impact.</summary>
    internal ref readonly PendingContact Contact(int slot) => ref contacts[slot];

    /// <summary>True, with the slot of the least event and its key; false if none is pending.</summary>
    internal bool TryGetLeast(out int slot, out EventKey key) => queue.TryGetLeast(out slot, out key);

    /// <summary>True and the key of the body's pending event, if it has one.</summary>
    internal bool TryGet(int slot, out EventKey key) => queue.TryGet(slot, out key);

    /// <summary>
    /// Whether nothing is pending up to and including the time of the least key but that, of one body and of another that waits for the
    /// same.
    /// </summary>
    internal bool AreTheOnlyLeast(int other, in EventKey least) => queue.AreTheOnlyLeast(other, least);

    /// <summary>Makes this the body's one pending event, in place of any other.</summary>
    internal void Set(int slot, in EventKey key, in PendingContact contact)
    {
        contacts[slot] = contact;
        queue.Set(slot, key);
    }

    /// <summary>Nothing is pending of the body any more.</summary>
    internal void Remove(int slot)
    {
        contacts[slot].Partner = PendingContact.NoPartner;
        queue.Remove(slot);
    }
}
