using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>Every body's timeline: its segments in the order of the keys that opened them, back to the edge of the window.</summary>
/// <remarks>
/// <para>Segments live in flat arrays, linked per body; nothing is overwritten, a segment is only appended, cut off at the end, or dropped
/// behind the window. Allocates only when more segments are alive than ever before. Old segments of all bodies are dropped together, in one
/// pass through memory when there is no room left: dropping them one by one, each long out of the cache, cost a quarter of an impact in a
/// dense fluid. The arrays grow if that frees less than one part in 32, by a sixty-fourth once they are large, or to the estimate. So a
/// world takes little more than its window needs.</para>
/// <para>It keeps a running hash of all events: the sum (modulo 2^64) of one hash a segment, so that appending and cutting are O(1) and the
/// order in which the events came leaves no trace.</para>
/// </remarks>
internal partial class TimelineStore
{
    internal const int None = -1;

    private readonly SimTime origin;
    private readonly SimDuration history;
    private readonly EventHashSum hashes = new();
    private readonly INewestSegments? newest; // notified of each body's newest segment
    private Piece[] pieces;
    private Link[] links; // apart, so that old segments are dropped without reading their paths
    private DenseOutput[] dense = Array.Empty<DenseOutput>(); // only once something is integrated
    private Hold[] holds = Array.Empty<Hold>(); // only once something is held
    private Spin[] spins = Array.Empty<Spin>(); // only once something turns
    private int free = None;
    private int used;
    private int[] first;
    private int[] last;
    private SimTime edge = SimTime.MinValue; // what lies before is dropped when room is needed

    /// <summary>
    /// An empty store of at most <paramref name="most"/> segments in all. Hashes count time from <paramref name="origin"/>, and
    /// <paramref name="newest"/> is notified of newest segments. There is room for as many bodies as are expected at first, and for few of
    /// them for a second segment each. The length of the history helps to estimate how much room it will need.
    /// </summary>
    internal TimelineStore(
        SimTime origin, int most = SimulationOptions.DefaultMaxSegments, INewestSegments? newest = null, int expected = 0, SimDuration history = default)
    {
        int room = FirstRoom;
        while (room < 2 * expected && room < Large)
        {
            room *= 2;
        }

        room = Math.Max(room, expected + (expected / Growth));
        pieces = new Piece[room];
        links = new Link[room];
        first = new int[expected];
        last = new int[expected];
        Array.Fill(first, None);
        Array.Fill(last, None);
        this.origin = origin;
        this.newest = newest;
        this.history = history;
        Most = most;
    }

    /// <summary>The serial of the segment that was opened last.</summary>
    internal long LastSerial { get; private set; }

    /// <summary>Notified of impacts that are cut; null for none.</summary>
    internal IImpactObserver? Observer { get; set; }

    /// <summary>Notified of segments that are opened; null for none.</summary>
    internal IOpeningObserver? Openings { get; set; }

    /// <summary>How many segments may be kept.</summary>
    internal int Most { get; }

    /// <summary>How many segments are kept now.</summary>
    internal int Alive { get; private set; }

    /// <summary>Makes room for a body's timeline.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= first.Length)
        {
            int known = first.Length;
            int size = Math.Max(slot + 1, Math.Max(16, known * 2));
            Array.Resize(ref first, size);
            Array.Resize(ref last, size);
            Array.Fill(first, None, known, size - known);
            Array.Fill(last, None, known, size - known);
        }

        first[slot] = None;
        last[slot] = None;
    }

    /// <summary>The body's newest segment, or <see cref="None"/>.</summary>
    internal int Last(int slot) => last[slot];

    /// <summary>The body's oldest segment that is kept, or <see cref="None"/>.</summary>
    internal int First(int slot) => first[slot];

    /// <summary>The data that members' segments carry besides their paths.</summary>
    internal CarriedContacts Carried { get; } = new();

    internal int Next(int segment) => links[segment].Next;

    internal int Previous(int segment) => links[segment].Previous;

    internal ref readonly MotionSegment Segment(int segment) => ref pieces[segment].Segment;

    internal DenseOutput Dense(int segment) => segment < dense.Length ? dense[segment] : default;

    /// <summary>The hold of a held segment; the default for any other.</summary>
    internal Hold HoldOf(int segment) => pieces[segment].Segment.Law == MotionLaw.Held ? holds[segment] : default;

    /// <summary>How the body turns on the segment.</summary>
    internal Spin SpinOf(int segment) => segment < spins.Length ? spins[segment] : default;

    /// <summary>The key of the event that opened the segment.</summary>
    internal ref readonly EventKey Key(int segment) => ref pieces[segment].Key;

    /// <summary>Whether the slot is some body's.</summary>
    internal bool IsKnown(int slot) => slot < last.Length && last[slot] != None;

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
        int at = last[slot];
        while (at != None && EventKey.Compare(pieces[at].Key, key) >= 0)
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
        if (free == None && (used == pieces.Length || used == Most))
        {
            DropAll(key.Time);
        }

        int at = free;
        if (at != None)
        {
            free = links[at].Next;
        }
        else
        {
            if (used == Most)
            {
                throw new TimelinesFullException(
                    $"At {key.Time.ToShortString()} the timelines hold {Most} segments, the most that the options allow: allow more, keep a shorter history,"
                    + " or look for what makes so many events.");
            }

            at = used++;
            if (at == pieces.Length)
            {
                Grow(key.Time, recent: 0);
            }
        }

        if (segment.IsDense)
        {
            if (at >= dense.Length)
            {
                Array.Resize(ref dense, pieces.Length);
            }

            dense[at] = output;
        }

        if (segment.Law == MotionLaw.Held)
        {
            if (at >= holds.Length)
            {
                Array.Resize(ref holds, pieces.Length);
            }

            holds[at] = hold;
        }

        if (spins.Length > 0 || !spin.IsNone)
        {
            if (at >= spins.Length)
            {
                Array.Resize(ref spins, pieces.Length);
            }

            spins[at] = spin;
        }

        int before = last[slot];
        ref Piece piece = ref pieces[at];
        piece.Segment = segment;
        piece.Key = key;
        links[at] = new Link { Closed = SimTime.MaxValue, Serial = ++LastSerial, Previous = before, Next = None, Owner = slot, Together = at };
        if (before == None)
        {
            first[slot] = at;
        }
        else
        {
            links[before].Next = at;
            links[before].Closed = key.Time;
        }

        last[slot] = at;
        newest?.Set(slot, segment, key.Time);
        Alive++;
        if (segment.IsOfIsland)
        {
            return; // the contacts it carries are still to be set, and count in its hash
        }

        if (IsPlain(at))
        {
            hashes.Add(key, segment, body, origin);
        }
        else
        {
            hashes.Value += HashOf(at, body);
        }
    }

    /// <summary>Begins what a member's segment, just appended, carries.</summary>
    internal void BeginMember(int segment, SimTime centre, SimTime still) => Carried.Begin(segment, centre, still, pieces.Length);

    /// <summary>Ends it: from here on it counts in the hash.</summary>
    internal void EndMember(int segment, BodyId body) => hashes.Value += HashOf(segment, body);

    /// <summary>Removes the body's segments keyed at or after <paramref name="key"/>; returns how many.</summary>
    internal int CutFrom(int slot, BodyId body, in EventKey key)
    {
        int cut = 0;
        while (last[slot] != None && EventKey.Compare(pieces[last[slot]].Key, key) >= 0)
        {
            CutLast(slot, body);
            cut++;
        }

        return cut;
    }

    /// <summary>Removes the body's newest segment, and it from its ring.</summary>
    internal void CutLast(int slot, BodyId body)
    {
        int at = last[slot];
        hashes.Value -= HashOf(at, body);
        if (Observer is not null && pieces[at].Key.Kind == EventKind.Impact)
        {
            Observer.OnCut(pieces[at].Key);
        }

        last[slot] = links[at].Previous;
        if (last[slot] == None)
        {
            first[slot] = None;
            newest?.Clear(slot);
        }
        else
        {
            links[last[slot]].Next = None;
            links[last[slot]].Closed = SimTime.MaxValue;
            newest?.Set(slot, pieces[last[slot]].Segment, pieces[last[slot]].Key.Time);
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
        Release(first[slot]);
        first[slot] = None;
        last[slot] = None;
        newest?.Clear(slot);
    }

    /// <summary>
    /// The segment that holds at <paramref name="time"/>, after all events of that tick; <see cref="None"/> before the first kept.
    /// </summary>
    internal int At(int slot, SimTime time)
    {
        int at = last[slot];
        while (at != None && links[at].Previous != None && links[links[at].Previous].Closed > time)
        {
            at = links[at].Previous;
        }

        return at == None || pieces[at].Key.Time > time ? None : at;
    }

    /// <summary>A segment and the key that opened it.</summary>
    private struct Piece
    {
        internal MotionSegment Segment;
        internal EventKey Key;
    }

    /// <summary>A segment's place among the others.</summary>
    private struct Link
    {
        internal SimTime Closed; // when the next was opened; MaxValue if there is none
        internal long Serial;
        internal int Previous;
        internal int Next;
        internal int Owner;
        internal int Together; // a ring through the segments that one impact opened
    }
}
