using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The crossings of sensors inside the window, of each body in canonical order, and which sensors each body is inside of.</summary>
/// <remarks>
/// Of what is older than the window it keeps what was crossed on a segment that is still in force there: the search for the next crossing
/// begins at the last. Not thread-safe. Allocates only when there are more crossings, or more bodies, than ever before.
/// </remarks>
internal sealed class CrossingLog
{
    internal const int None = -1;

    private const int FirstRoom = 16;
    private const int BitsPerWord = 64;

    private readonly TimelineStore timelines;
    private readonly BodyTable bodies;
    private readonly Progress progress;
    private readonly int words; // of bits, for each body
    private ulong[] inside;
    private int[] last; // by slot: its newest crossing
    private Entry[] entries = Array.Empty<Entry>();
    private int used;
    private int free = None;

    /// <summary>No crossings yet.</summary>
    /// <param name="sensors">How many sensors the scene has.</param>
    /// <param name="bodies">The bodies.</param>
    /// <param name="timelines">Their paths.</param>
    /// <param name="progress">How far the world is simulated and kept.</param>
    internal CrossingLog(int sensors, BodyTable bodies, TimelineStore timelines, Progress progress)
    {
        SensorCount = sensors;
        words = (sensors + BitsPerWord - 1) / BitsPerWord;
        this.timelines = timelines;
        this.bodies = bodies;
        this.progress = progress;
        inside = Array.Empty<ulong>();
        last = Array.Empty<int>();
    }

    /// <summary>How many sensors there are.</summary>
    internal int SensorCount { get; }

    /// <summary>Notified of crossings; null for none.</summary>
    internal ICrossingObserver? Observer { get; set; }

    /// <summary>Notified of what rules may hear of; null, the default, where there are none.</summary>
    internal IRuleTriggers? Triggers { get; set; }

    /// <summary>The serial of the crossing that was added last.</summary>
    internal long LastSerial { get; private set; }

    /// <summary>The sum, modulo 2^64, of the hashes of all crossings ever added and not cut again, forgotten ones included.</summary>
    internal ulong EventHash { get; private set; }

    /// <summary>Makes room for a body, which is inside of no sensor.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= last.Length)
        {
            int size = Math.Max(slot + 1, Math.Max(16, last.Length * 2));
            Array.Resize(ref last, size);
            Array.Resize(ref inside, size * words);
        }

        last[slot] = None;
        Array.Clear(inside, slot * words, words);
    }

    /// <summary>Forgets a body that is gone for good.</summary>
    internal void Forget(int slot)
    {
        while (last[slot] != None)
        {
            int at = last[slot];
            last[slot] = entries[at].Previous;
            Release(at);
        }

        Array.Clear(inside, slot * words, words);
    }

    /// <summary>Whether a body is inside of a sensor, after all its crossings.</summary>
    internal bool IsInside(int slot, int sensor) => (inside[(slot * words) + (sensor / BitsPerWord)] & (1UL << (sensor % BitsPerWord))) != 0;

    /// <summary>Whether a body is inside of a sensor after all crossings up to and including a time.</summary>
    internal bool IsInside(int slot, int sensor, SimTime time)
    {
        bool isInside = IsInside(slot, sensor);
        for (int at = last[slot]; at != None && entries[at].Key.Time > time; at = entries[at].Previous)
        {
            isInside ^= Sensor(at) == sensor;
        }

        return isInside;
    }

    /// <summary>Whether a body is inside of a sensor after all crossings up to and including a key.</summary>
    internal bool IsInside(int slot, int sensor, in EventKey key)
    {
        bool isInside = IsInside(slot, sensor);
        for (int at = LastSince(slot, sensor, key.JustAfter); at != None; at = PreviousSince(at, key.JustAfter))
        {
            isInside = !isInside;
        }

        return isInside;
    }

    /// <summary>The body's newest crossing, or <see cref="None"/>.</summary>
    internal int Last(int slot) => last[slot];

    /// <summary>The body's crossing before one, or <see cref="None"/>.</summary>
    internal int Previous(int crossing) => entries[crossing].Previous;

    internal ref readonly EventKey Key(int crossing) => ref entries[crossing].Key;

    internal Crossing At(int crossing) => new(entries[crossing].Key, entries[crossing].Entered);

    /// <summary>A number that no other crossing of this log ever has.</summary>
    internal long Serial(int crossing) => entries[crossing].Serial;

    /// <summary>The last crossing of a body and a sensor from a key on, or <see cref="None"/>.</summary>
    internal int LastSince(int slot, int sensor, in EventKey key) => SinceFrom(last[slot], sensor, key);

    /// <summary>The one before that, of the same sensor.</summary>
    internal int PreviousSince(int crossing, in EventKey key) => SinceFrom(entries[crossing].Previous, Sensor(crossing), key);

    /// <summary>Adds a body's next crossing; reports it.</summary>
    internal void Add(int slot, in EventKey key)
    {
        int at = Append(slot, key);
        Observer?.OnCrossing(At(at));
    }

    /// <summary>Adds a body's next crossing without a report: it was reported before, and never reported as cut.</summary>
    internal void PutBack(int slot, in EventKey key) => Append(slot, key);

    /// <summary>Removes a body's crossings keyed at or after a key.</summary>
    internal void CutFrom(int slot, in EventKey key)
    {
        while (last[slot] != None && EventKey.Compare(entries[last[slot]].Key, key) >= 0)
        {
            int at = last[slot];
            Crossing cut = At(at);
            Toggle(slot, cut.Sensor);
            EventHash -= HashOf(cut);
            last[slot] = entries[at].Previous;
            Release(at);
            Observer?.OnCut(cut);
            Triggers?.OnCut(cut.Body, cut.Key);
        }
    }

    /// <summary>Begins with what a snapshot has of a body: the sensors that it is inside of, and what it crossed on its segment.</summary>
    internal void Begin(int slot, int[] insideOf, Crossing[] crossings)
    {
        foreach (int sensor in insideOf)
        {
            Toggle(slot, sensor);
        }

        for (int i = crossings.Length - 1; i >= 0; i--)
        {
            Toggle(slot, crossings[i].Sensor); // back to when the segment was opened
        }

        foreach (Crossing crossing in crossings)
        {
            Append(slot, crossing.Key);
            EventHash -= HashOf(crossing); // it is in the hash that the snapshot has
        }
    }

    /// <summary>What the crossings of a body after a time add to <see cref="EventHash"/>.</summary>
    internal ulong HashAfter(int slot, SimTime time)
    {
        ulong sum = 0;
        for (int at = last[slot]; at != None && entries[at].Key.Time > time; at = entries[at].Previous)
        {
            sum += HashOf(At(at));
        }

        return sum;
    }

    private int Append(int slot, in EventKey key)
    {
        int sensor = unchecked((int)key.Sequence);
        Toggle(slot, sensor);
        int at = TakeRoom();
        entries[at] = new Entry { Key = key, Entered = IsInside(slot, sensor), Previous = last[slot], Serial = ++LastSerial };
        last[slot] = at;
        EventHash += HashOf(At(at));
        Triggers?.OnCrossing(At(at));
        return at;
    }

    private int Sensor(int crossing) => unchecked((int)entries[crossing].Key.Sequence);

    private int SinceFrom(int crossing, int sensor, in EventKey key)
    {
        int at = crossing;
        while (at != None && EventKey.Compare(entries[at].Key, key) >= 0)
        {
            if (Sensor(at) == sensor)
            {
                return at;
            }

            at = entries[at].Previous;
        }

        return None;
    }

    private void Toggle(int slot, int sensor) => inside[(slot * words) + (sensor / BitsPerWord)] ^= 1UL << (sensor % BitsPerWord);

    private ulong HashOf(in Crossing crossing)
    {
        StableHash hash = default;
        hash.Add(crossing.Time - progress.Start);
        hash.Add(((ulong)crossing.Key.Round << 32) | (byte)EventKind.Crossing);
        hash.Add(crossing.Body.Packed);
        hash.Add(((ulong)crossing.Key.Sequence << 1) | (crossing.Entered ? 1UL : 0));
        return hash.Value;
    }

    private int TakeRoom()
    {
        if (free == None && used == entries.Length)
        {
            int dropped = DropAll();
            if (dropped <= entries.Length / 2)
            {
                Array.Resize(ref entries, Math.Max(FirstRoom, entries.Length * 2));
            }
        }

        int at = free;
        if (at == None)
        {
            return used++;
        }

        free = entries[at].Previous;
        return at;
    }

    /// <summary>Drops what lies behind the window and before the segments that are in force at its edge; returns how many.</summary>
    private int DropAll()
    {
        int dropped = 0;
        foreach (int slot in bodies)
        {
            int after = None;
            int at = last[slot];
            for (; at != None && entries[at].Key.Time >= progress.HistoryEdge; at = entries[at].Previous)
            {
                after = at;
            }

            int segment = at == None ? TimelineStore.None : timelines.At(slot, progress.HistoryEdge - SimDuration.OneTick);
            if (segment == TimelineStore.None)
            {
                continue;
            }

            for (; at != None && EventKey.Compare(entries[at].Key, timelines.Key(segment)) >= 0; at = entries[at].Previous)
            {
                after = at;
            }

            (after == None ? ref last[slot] : ref entries[after].Previous) = None;
            while (at != None)
            {
                int previous = entries[at].Previous;
                Release(at);
                at = previous;
                dropped++;
            }
        }

        return dropped;
    }

    private void Release(int at)
    {
        entries[at].Previous = free;
        free = at;
    }

    private struct Entry
    {
        internal EventKey Key;
        internal long Serial;
        internal int Previous;
        internal bool Entered;
    }
}
