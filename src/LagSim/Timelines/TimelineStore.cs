using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>Every body's timeline: its segments in the order of the keys that opened them, back to the edge of the window.</summary>
/// <remarks>
/// <para>Segments live in flat arrays, linked per body; nothing is overwritten, a segment is only appended, cut off at the end, or dropped
/// behind the window. Old segments of all bodies are dropped together, in one pass through memory when there is no room left: to look for
/// them one by one, each long out of the cache, cost a quarter of an impact in a dense fluid. If that frees little, the arrays grow, by
/// <see cref="TimelineGrowthPolicy"/>. Allocates only when more segments are alive than ever before.</para>
/// <para>It keeps a running hash of all events: the sum (modulo 2^64) of one hash a segment, so that appending and cutting are O(1) and the
/// order in which the events came leaves no trace.</para>
/// </remarks>
internal sealed class TimelineStore
{
    internal const int None = -1;

    private const int LittleRoom = 32; // where less than one part in this many can be dropped, it would soon be looked for again

    private readonly TimelineGrowthPolicy growth;
    private readonly EventHashSum hashes;
    private readonly INewestSegmentObserver? newest; // is notified of each body's newest segment
    private OpenedSegment[] segments;
    private SegmentLinks[] links;
    private int free = None;
    private int used;
    private TimelineEnds[] ends; // by body

    /// <summary>No timelines yet.</summary>
    /// <param name="origin">From when hashes count time.</param>
    /// <param name="maxSegments">How many segments there may be in all.</param>
    /// <param name="newest">Is notified of each body's newest segment; null for nothing.</param>
    /// <param name="expectedBodies">For how many bodies there is room at first.</param>
    /// <param name="growth">How it grows; by default as one of no history.</param>
    internal TimelineStore(
        SimTime origin, int maxSegments = SimulationOptions.DefaultMaxSegments, INewestSegmentObserver? newest = null,
        int expectedBodies = 0, TimelineGrowthPolicy? growth = null)
    {
        int room = TimelineGrowthPolicy.First(expectedBodies);
        segments = new OpenedSegment[room];
        links = new SegmentLinks[room];
        ends = new TimelineEnds[expectedBodies];
        Array.Fill(ends, TimelineEnds.None);
        hashes = new EventHashSum(origin);
        this.newest = newest;
        this.growth = growth ?? new TimelineGrowthPolicy(origin, default);
        MaxSegments = maxSegments;
    }

    /// <summary>The serial of the segment that was opened last.</summary>
    internal long LastSerial { get; private set; }

    /// <summary>What only some segments have.</summary>
    internal SegmentExtras Extras { get; } = new();

    /// <summary>Notified of impacts that are cut; null for none.</summary>
    internal IImpactObserver? Observer { get; set; }

    /// <summary>Notified of what rules may hear of; null, the default, where there are none.</summary>
    internal IRuleTriggers? Triggers { get; set; }

    /// <summary>Notified of bodies that are lost; null, the default, for none.</summary>
    internal ILossObserver? Losses { get; set; }

    /// <summary>Notified of segments that are opened; null for none.</summary>
    internal ISegmentOpenedObserver? Openings { get; set; }

    /// <summary>The earliest instant that is still asked for; the segments that only earlier ones need may be gone.</summary>
    internal SimTime Edge { get; private set; } = SimTime.MinValue;

    /// <summary>How many segments may be kept.</summary>
    internal int MaxSegments { get; }

    /// <summary>How many segments are kept now.</summary>
    internal int Alive { get; private set; }

    /// <summary>Makes room for a body's timeline.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= ends.Length)
        {
            int known = ends.Length;
            Array.Resize(ref ends, Math.Max(slot + 1, Math.Max(16, known * 2)));
            Array.Fill(ends, TimelineEnds.None, known, ends.Length - known);
        }

        ends[slot] = TimelineEnds.None;
    }

    /// <summary>The body's newest segment, or <see cref="None"/>.</summary>
    internal int Last(int slot) => ends[slot].Last;

    /// <summary>The body's oldest segment that is kept, or <see cref="None"/>.</summary>
    internal int First(int slot) => ends[slot].First;

    /// <summary>What members' segments carry besides their paths.</summary>
    internal CarriedContacts Carried => Extras.Carried;

    internal int Next(int segment) => links[segment].Next;

    internal int Previous(int segment) => links[segment].Previous;

    internal ref readonly MotionSegment Segment(int segment) => ref segments[segment].Segment;

    internal DenseOutput Dense(int segment) => Extras.Dense(segment);

    /// <summary>The hold of a segment that is held; of any other the default.</summary>
    internal Hold HoldOf(int segment) => segments[segment].Segment.Law == MotionLaw.Held ? Extras.Hold(segment) : default;

    /// <summary>How the body turns on the segment.</summary>
    internal Spin SpinOf(int segment) => Extras.Spin(segment);

    /// <summary>The key of the event that opened the segment.</summary>
    internal ref readonly EventKey Key(int segment) => ref segments[segment].Key;

    /// <summary>Whether the slot is some body's.</summary>
    internal bool IsKnown(int slot) => slot < ends.Length && ends[slot].Last != None;

    /// <summary>
    /// A number that no other segment of this store ever has, 0 for one that is gone; it shows whether a remembered segment is still the
    /// same.
    /// </summary>
    internal long Serial(int segment) => links[segment].Serial;

    /// <summary>The slot of the segment's body.</summary>
    internal int Owner(int segment) => links[segment].Owner;

    /// <summary>The body's newest segment keyed before <paramref name="key"/>; <see cref="None"/> if none that is kept is.</summary>
    internal int Before(int slot, in EventKey key)
    {
        int at = ends[slot].Last;
        while (at != None && EventKey.Compare(segments[at].Key, key) >= 0)
        {
            at = links[at].Previous;
        }

        return at;
    }

    /// <summary>Opens the body's next segment.</summary>
    /// <exception cref="TimelinesFullException">There are as many as may be.</exception>
    internal void Append(int slot, BodyId body, in EventKey key, in MotionSegment segment, in DenseOutput output, in Hold hold = default,
        in Spin spin = default)
    {
        Openings?.OnOpened(slot, key);
        Triggers?.OnOpened(body, key);
        int at = TakeRoom(key.Time);
        int before = ends[slot].Last;
        if (Losses is not null && IsLossOf(body, key))
        {
            Losses.OnLost(key, segments[before].Segment);
        }

        Extras.Set(at, before, segment, output, hold, spin, segments.Length);
        ref OpenedSegment opened = ref segments[at];
        opened.Segment = segment;
        opened.Key = key;
        links[at] = SegmentLinks.OfNewest(at, ++LastSerial, slot, before);
        if (before == None)
        {
            ends[slot].First = at;
        }
        else
        {
            links[before].Next = at;
            links[before].Closed = key.Time;
        }

        ends[slot].Last = at;
        newest?.Set(slot, segment, key.Time);
        Alive++;
        if (segment.IsOfIsland)
        {
            return; // until EndMember: what it carries counts in its hash
        }

        if (!Extras.MayAddToHash(segment) && opened.IsEvent)
        {
            hashes.Add(key, segment, body); // nothing but what every segment has
        }
        else
        {
            hashes.Value += HashOf(at, body);
        }
    }

    /// <summary>Begins what a member's segment, just appended, carries.</summary>
    internal void BeginMember(int segment, SimTime centre, SimTime still) => Carried.Begin(segment, centre, still, segments.Length);

    /// <summary>Ends it: from here on it counts in the hash.</summary>
    internal void EndMember(int segment, BodyId body) => hashes.Value += HashOf(segment, body);

    /// <summary>Removes the body's segments keyed at or after <paramref name="key"/>, but not the first, with which its timeline begins;
    /// returns how many.</summary>
    internal int CutFrom(int slot, BodyId body, in EventKey key)
    {
        int cut = 0;
        while (ends[slot].Last != ends[slot].First && EventKey.Compare(segments[ends[slot].Last].Key, key) >= 0)
        {
            CutLast(slot, body);
            cut++;
        }

        return cut;
    }

    /// <summary>Removes the body's newest segment, and it from its ring.</summary>
    internal void CutLast(int slot, BodyId body)
    {
        int at = ends[slot].Last;
        hashes.Value -= HashOf(at, body);
        if (Observer is not null && segments[at].Key.Kind == EventKind.Impact)
        {
            Observer.OnCut(segments[at].Key);
        }

        Triggers?.OnCut(body, segments[at].Key);
        if (Losses is not null && IsLossOf(body, segments[at].Key))
        {
            Losses.OnCut(segments[at].Key);
        }

        ends[slot].Last = links[at].Previous;
        if (ends[slot].Last == None)
        {
            ends[slot].First = None;
            newest?.Clear(slot);
        }
        else
        {
            links[ends[slot].Last].Next = None;
            links[ends[slot].Last].Closed = SimTime.MaxValue;
            newest?.Set(slot, segments[ends[slot].Last].Segment, segments[ends[slot].Last].Key.Time);
        }

        int before = at;
        while (links[before].Together != at)
        {
            before = links[before].Together;
        }

        links[before].Together = links[at].Together;
        Release(at);
    }

    /// <summary>Forgets the one segment that is left of a body.</summary>
    internal void Forget(int slot)
    {
        Release(ends[slot].First);
        ends[slot] = TimelineEnds.None;
        newest?.Clear(slot);
    }

    /// <summary>
    /// The segment that holds at <paramref name="time"/>, after all events of that tick; <see cref="None"/> before the first kept.
    /// </summary>
    internal int At(int slot, SimTime time)
    {
        int at = ends[slot].Last;
        while (at != None && links[at].Previous != None && links[links[at].Previous].Closed > time)
        {
            at = links[at].Previous;
        }

        return at == None || segments[at].Key.Time > time ? None : at;
    }

    /// <summary>The sum of the hashes of all segments ever opened and not cut off again, dropped ones included.</summary>
    internal ulong EventHash => hashes.Value;

    /// <summary>The hash from which this store goes on, which has what its segments would add in it already.</summary>
    internal void ContinueFrom(ulong eventHash) => hashes.Value = eventHash;

    /// <summary>What a segment adds to <see cref="EventHash"/>; 0 where no event opened it.</summary>
    internal ulong HashOf(int segment, BodyId body)
    {
        if (!segments[segment].IsEvent)
        {
            return 0;
        }

        ref readonly MotionSegment motion = ref segments[segment].Segment;
        StableHash hash = hashes.Of(segments[segment].Key, motion, body);
        Extras.AddTo(ref hash, segment, motion, hashes.Origin);
        return hash.Value;
    }

    /// <summary>See <see cref="OpenedSegment.IsNote"/>.</summary>
    internal bool IsNote(int segment) => segments[segment].IsNote;

    /// <summary>The next in the ring of segments that one impact opened; itself if it has no other.</summary>
    internal int Together(int segment) => links[segment].Together;

    /// <summary>The newest segments of these bodies were opened by one impact.</summary>
    internal void Join(Span<int> slots)
    {
        for (int i = 0; i < slots.Length; i++)
        {
            links[ends[slots[i]].Last].Together = ends[slots[i + 1 == slots.Length ? 0 : i + 1]].Last;
        }
    }

    /// <summary>For how many segments there is room without more memory.</summary>
    internal int Room => segments.Length;

    /// <summary>Instants before this are asked for no more; what only they need is dropped when room is needed.</summary>
    internal void ForgetBefore(SimTime time) => Edge = SimTime.Max(Edge, time);

    /// <summary>
    /// Drops of one body what is no longer needed for instants from <paramref name="time"/> on; the last segment opened before it stays.
    /// </summary>
    internal void DropBefore(int slot, SimTime time)
    {
        for (int at = ends[slot].First, next; at != None && links[at].Closed < time; at = next)
        {
            next = links[at].Next;
            Drop(at);
        }
    }

    /// <summary>Whether an event is the loss of that body, and not of one that it lay on.</summary>
    private static bool IsLossOf(BodyId body, in EventKey key) => key.Kind == EventKind.Lost && key.Body == body;

    /// <summary>A place for one more segment.</summary>
    private int TakeRoom(SimTime now)
    {
        if (free == None && (used == segments.Length || used == MaxSegments))
        {
            DropAll(now);
        }

        int at = free;
        if (at != None)
        {
            free = links[at].Next;
            return at;
        }

        if (used == MaxSegments)
        {
            throw new TimelinesFullException(
                $"At {now.ToShortString()} the timelines hold {MaxSegments} segments, the most that the options allow: allow more, keep a"
                + " shorter history, or look for what makes so many events.");
        }

        if (used == segments.Length)
        {
            Grow(now, recent: 0);
        }

        return used++;
    }

    /// <summary>
    /// Drops what lies behind the window; and makes room for more if that was little, else it would soon be looked for again.
    /// </summary>
    private void DropAll(SimTime now)
    {
        int recent = 0;
        SimTime late = TimelineGrowthPolicy.RecentStart(now, Edge);

        // From the end, so that what is freed is given out from the beginning: segments are opened in one direction through memory.
        for (int at = used - 1; at >= 0; at--)
        {
            SimTime closed = links[at].Closed;
            if (closed < Edge)
            {
                Drop(at);
            }
            else if (closed > late && closed <= now)
            {
                recent++;
            }
        }

        if (Alive > used - (used / LittleRoom) && used < MaxSegments)
        {
            Grow(now, recent);
        }
    }

    /// <summary>Takes a segment that has a successor out of its timeline; those before it, which are older, are dropped with it.</summary>
    private void Drop(int at)
    {
        int previous = links[at].Previous;
        int next = links[at].Next;
        links[next].Previous = previous;
        if (previous == None)
        {
            ends[links[at].Owner].First = next;
        }
        else
        {
            links[previous].Next = next;
        }

        Release(at);
    }

    private void Release(int at)
    {
        if (segments[at].Segment.IsOfIsland)
        {
            Carried.Release(at);
        }

        links[at].Serial = 0;
        links[at].Closed = SimTime.MaxValue; // nothing that could be dropped
        links[at].Next = free;
        free = at;
        Alive--;
    }

    private void Grow(SimTime now, int recent)
    {
        int room = growth.Next(segments.Length, ends.Length, now, Edge, recent);
        Array.Resize(ref segments, room);
        Array.Resize(ref links, room);
        Extras.Grow(room);
    }
}
