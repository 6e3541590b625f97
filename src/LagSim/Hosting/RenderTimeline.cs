using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>One body's timeline inside a render snapshot: a copy that follows the simulation's by taking over only what changed.</summary>
internal sealed class RenderTimeline
{
    private const double MinStep = 1e-6; // m; a smaller step between two segments is rounding, or a bounce's height
    private const int LeastRoom = 32; // entries; less is not given back

    private Entry[] entries = Array.Empty<Entry>(); // a body that is known only by name never needs one
    private int first;
    private int end;

    /// <summary>How many entries there is room for.</summary>
    internal int Room => entries.Length;

    /// <summary>Makes this equal to the simulation's timeline of the slot from <paramref name="edge"/> on.</summary>
    internal void Follow(TimelineStore store, int slot, SimTime edge)
    {
        if (end > first && entries[first].Opened > edge)
        {
            first = end = 0; // the edge went back, maybe behind what was dropped here; where nothing was, it is little to copy
        }

        // Serials only grow along a timeline, and a segment once cut never comes back under its old one: the newest serial that both
        // have is where they part.
        int fresh = 0;
        int at = store.Last(slot);
        while (at != TimelineStore.None)
        {
            while (end > first && entries[end - 1].Serial > store.Serial(at))
            {
                end--;
            }

            if (end > first && entries[end - 1].Serial == store.Serial(at))
            {
                break;
            }

            bool covers = store.Key(at).Time <= edge;
            fresh += covers && !store.Segment(at).IsPresent ? 0 : 1; // before the first entry there is no body; that needs no entry of its own
            at = covers ? TimelineStore.None : store.Previous(at);
        }

        if (at == TimelineStore.None)
        {
            first = end = 0;
        }

        Reserve(fresh);
        at = store.Last(slot);
        for (int i = fresh - 1; i >= 0; i--)
        {
            entries[end + i] = new Entry(store.Serial(at), store.Key(at).Time, store.Segment(at), store.Dense(at), store.SpinOf(at), store.Extras.Filter(at), store.HoldOf(at));
            at = store.Previous(at);
        }

        end += fresh;
        while (end - first > 1 && entries[first + 1].Opened <= edge)
        {
            first++;
        }
    }

    internal BodyState At(SimTime time, in PeriodicBox box)
    {
        int at = EntryAt(time);
        return at < 0 ? default : State(entries[at], time, box);
    }

    /// <summary>The hold at an instant; false if no peer holds the body.</summary>
    internal bool TryReadHold(SimTime time, out Hold hold)
    {
        int at = EntryAt(time);
        bool isHeld = at >= 0 && entries[at].IsHeld;
        hold = isHeld ? entries[at].Hold : default;
        return isHeld;
    }

    /// <summary>The last hold that ended after one instant and up to another, and when; false if none did.</summary>
    internal bool TryReadHoldEnd(SimTime after, SimTime upTo, out Hold hold, out SimTime at)
    {
        for (int i = end - 1; i > first && entries[i].Opened > after; i--)
        {
            bool goesOn = entries[i].IsHeld && entries[i].Hold.Peer == entries[i - 1].Hold.Peer;
            if (entries[i].Opened <= upTo && entries[i - 1].IsHeld && !goesOn)
            {
                hold = entries[i - 1].Hold;
                at = entries[i].Opened;
                return true;
            }
        }

        hold = default;
        at = default;
        return false;
    }

    /// <summary>The entry that holds at an instant; negative before the first.</summary>
    private int EntryAt(SimTime time)
    {
        int low = first;
        int high = end; // the last entry opened at or before the time lies below
        while (low < high)
        {
            int middle = (low + high) >> 1;
            if (entries[middle].Opened <= time)
            {
                low = middle + 1;
            }
            else
            {
                high = middle;
            }
        }

        return low == first ? -1 : low - 1;
    }

    /// <summary>
    /// The largest change of velocity at one stroke after one instant and up to another, in m/s; infinite if the body was put elsewhere,
    /// came or went.
    /// </summary>
    internal double SuddenChange(SimTime after, SimTime upTo, in PeriodicBox box)
    {
        double largest = 0;
        for (int i = end - 1; i >= first && entries[i].Opened > after; i--)
        {
            if (entries[i].Opened > upTo)
            {
                continue;
            }

            SimTime time = entries[i].Opened;
            BodyState now = State(entries[i], time, box);
            BodyState before = i > first ? State(entries[i - 1], time, box) : default;
            bool wasThere = before.Motion != MotionLaw.Absent, isThere = now.Motion != MotionLaw.Absent;
            if (wasThere || isThere)
            {
                bool stays = wasThere && isThere && box.Nearest(now.Position - before.Position).Length <= MinStep;
                largest = Math.Max(largest, stays ? (now.Velocity - before.Velocity).Length : double.PositiveInfinity);
            }
        }

        return largest;
    }

    private static BodyState State(in Entry entry, SimTime time, in PeriodicBox box) =>
        Paths.StateOf(entry.Segment, time.SecondsSince(entry.Segment.Epoch), entry.Dense, box, entry.Spin, entry.Filter);

    private void Reserve(int fresh)
    {
        if (end + fresh <= entries.Length)
        {
            return;
        }

        int kept = end - first;
        Entry[] target = kept + fresh > entries.Length / 2 ? new Entry[Math.Max(2 * (kept + fresh), 8)] : entries;
        Array.Copy(entries, first, target, 0, kept);
        entries = target;
        first = 0;
        end = kept;
    }

    /// <summary>
    /// Gives half of the room back if less than a quarter of it is needed. Every snapshot has a timeline of every body, so without this each of
    /// them would keep for good what the liveliest moment of its body took. To be called now and then: what is given back may be needed again.
    /// </summary>
    internal void GiveBack()
    {
        int kept = end - first;
        if (entries.Length <= LeastRoom || kept >= entries.Length / 4)
        {
            return;
        }

        Entry[] smaller = new Entry[Math.Max(entries.Length / 2, LeastRoom)];
        Array.Copy(entries, first, smaller, 0, kept);
        entries = smaller;
        first = 0;
        end = kept;
    }

    private readonly struct Entry
    {
        internal Entry(long serial, SimTime opened, in MotionSegment segment, in DenseOutput dense, in Spin spin, CollisionFilter filter, in Hold hold)
        {
            Serial = serial;
            Opened = opened;
            Segment = segment;
            Dense = dense;
            Spin = spin;
            Filter = filter;
            Hold = hold;
        }

        internal long Serial { get; }

        internal SimTime Opened { get; }

        internal MotionSegment Segment { get; }

        internal DenseOutput Dense { get; }

        internal Spin Spin { get; }

        internal CollisionFilter Filter { get; }

        internal Hold Hold { get; }

        internal bool IsHeld => Segment.Law == MotionLaw.Held;
    }
}
