using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>Puts another peer's entries in order by number: each is taken once, and only after the one before it.</summary>
/// <remarks>Early entries are buffered, up to <see cref="SendWindow.MaxEntries"/>; those further ahead have to be sent again.</remarks>
internal sealed class ReceiveWindow
{
    private const int MinSlots = 256; // a power of two, and more than a datagram's entries

    private Slot[] slots = Array.Empty<Slot>();

    /// <param name="received">The last entry that is already here.</param>
    internal ReceiveWindow(uint received) => Received = received;

    /// <summary>The number of the last entry taken.</summary>
    internal uint Received { get; private set; }

    /// <summary>The greatest promise that follows entries which were all taken; the earliest instant before there is one.</summary>
    internal SimTime Promised { get; private set; } = SimTime.MinValue;

    /// <summary>Whether the next entry is here.</summary>
    internal bool HasNext => Received < uint.MaxValue && IsHeld(Received + 1);

    /// <summary>The number of entries it has room for.</summary>
    internal int Room => slots.Length;

    /// <summary>Buffers an entry until it is taken; a second one with the same number is ignored.</summary>
    /// <returns>False for one that is too far ahead.</returns>
    internal bool Put(uint number, in UpdateEntry entry)
    {
        if (number <= Received)
        {
            return true;
        }

        if (number - Received > SendWindow.MaxEntries)
        {
            return false;
        }

        MakeRoom((int)(number - Received));
        ref Slot slot = ref At(number);
        if (!slot.IsHeld)
        {
            slot.Entry = entry;
            slot.IsHeld = true;
        }

        return true;
    }

    /// <summary>
    /// Records a promise: no entry after this number is before that time. It counts once the entries up to the number were taken.
    /// </summary>
    internal void Promise(uint upTo, SimTime time)
    {
        if (upTo <= Received)
        {
            Promised = SimTime.Max(Promised, time);
        }
        else if (upTo - Received <= slots.Length)
        {
            ref Slot slot = ref At(upTo);
            slot.Promise = slot.HasPromise ? SimTime.Max(slot.Promise, time) : time;
            slot.HasPromise = true;
        }
    }

    /// <summary>Takes the next entry.</summary>
    /// <exception cref="InvalidOperationException">It is not here: see <see cref="HasNext"/>.</exception>
    internal UpdateEntry Take()
    {
        if (!HasNext)
        {
            throw new InvalidOperationException($"Entry {Received + 1L} has not come.");
        }

        Received++;
        ref Slot slot = ref At(Received);
        UpdateEntry entry = slot.Entry;
        Promised = slot.HasPromise ? SimTime.Max(Promised, slot.Promise) : Promised;
        slot = default;
        return entry;
    }

    private bool IsHeld(uint number) => number - Received <= slots.Length && At(number).IsHeld;

    private ref Slot At(uint number) => ref slots[(int)(number & (uint)(slots.Length - 1))];

    private void MakeRoom(int ahead)
    {
        if (ahead <= slots.Length)
        {
            return;
        }

        Slot[] former = slots;
        int length = Math.Max(MinSlots, former.Length);
        while (length < ahead)
        {
            length *= 2;
        }

        slots = new Slot[length];
        for (uint n = 1; n <= former.Length && n <= uint.MaxValue - Received; n++)
        {
            At(Received + n) = former[(int)((Received + n) & (uint)(former.Length - 1))];
        }
    }

    private struct Slot
    {
        internal UpdateEntry Entry;
        internal SimTime Promise;
        internal bool IsHeld;
        internal bool HasPromise;
    }
}
