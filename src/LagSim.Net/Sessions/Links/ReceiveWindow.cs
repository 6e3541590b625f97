using System;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>
/// Puts the entries that another peer sends into the order of their numbers: each is taken once, and none before the one before it.
/// </summary>
/// <remarks>
/// What comes before its turn is kept, up to <see cref="SendWindow.MaxEntries"/>; what is further ahead is left to be sent again.
/// </remarks>
internal sealed class ReceiveWindow
{
    private const int LeastSlots = 256; // a power of two, and more than a datagram's entries

    private Slot[] slots = Array.Empty<Slot>();

    /// <param name="received">The entries up to this one are here.</param>
    internal ReceiveWindow(uint received) => Received = received;

    /// <summary>The entries up to this one were taken.</summary>
    internal uint Received { get; private set; }

    /// <summary>
    /// The greatest promise about what comes after entries that were all taken; the earliest instant before there is one.
    /// </summary>
    internal SimTime Promised { get; private set; } = SimTime.MinValue;

    /// <summary>Whether the next entry is here.</summary>
    internal bool HasNext => Received < uint.MaxValue && IsHeld(Received + 1);

    /// <summary>How many entries there is room for.</summary>
    internal int Room => slots.Length;

    /// <summary>Keeps an entry until it is taken; of two of one number the first.</summary>
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
    /// Notes a promise: no entry after this number is before that time. It counts once the entries up to the number were taken.
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
    /// <exception cref="InvalidOperationException">It is not here: not <see cref="HasNext"/>.</exception>
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
        int length = Math.Max(LeastSlots, former.Length);
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
