using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// The segments that the current heal has cut from earlier paths, kept as long as they are few. Where the new paths reconverge with them,
/// they are put back.
/// </summary>
/// <remarks>
/// These are copies, since the store reuses the room of cut segments. It allocates only until it has held as much as it ever does.
/// </remarks>
internal class CutPaths
{
    /// <summary>A heal that has cut more, or that has touched more bodies, runs to its end: it would hardly reconverge.</summary>
    internal const int Most = 256;

    private const int None = -1;

    private readonly List<Piece> pieces = new();
    private readonly List<int> order = new(); // of pieces that are put back
    private readonly List<PersistentContact> contacts = new(); // of pieces, one list after the other
    private readonly List<(int Slot, int Earliest)> bodies = new();
    private Comparison<int>? byKey; // made when something is put back
    private int[] joined = Array.Empty<int>();
    private int differing; // a body that was not on its old path at the last test

    /// <summary>Whether everything that the heal has cut is here.</summary>
    internal bool IsWhole { get; private set; }

    /// <summary>The serial of the newest segment that stood before the heal.</summary>
    internal long LastSerial { get; private set; }

    /// <summary>How many bodies the heal has touched.</summary>
    internal int BodyCount => bodies.Count;

    /// <summary>A heal begins.</summary>
    internal void Begin(long lastSerial)
    {
        GiveUp();
        IsWhole = true;
        LastSerial = lastSerial;
    }

    /// <summary>Discards the saved segments. The heal will run to its horizon.</summary>
    internal void GiveUp()
    {
        IsWhole = false;
        pieces.Clear();
        contacts.Clear();
        bodies.Clear();
        differing = 0;
    }

    /// <summary>The slot of the n-th body that was touched.</summary>
    internal int SlotAt(int n) => bodies[n].Slot;

    /// <summary>The heal rewinds a body that it had not touched.</summary>
    internal void Touch(int slot)
    {
        if (IsWhole)
        {
            bodies.Add((slot, None));
            IsWhole = bodies.Count <= Most;
        }
    }

    /// <summary>Of a body that was touched the newest segment is about to be cut.</summary>
    internal void Keep(TimelineStore timelines, int slot, int segment)
    {
        if (!IsWhole || timelines.Serial(segment) > LastSerial)
        {
            return; // or it is of this heal's own making
        }

        int n = bodies.Count - 1;
        while (bodies[n].Slot != slot)
        {
            n--;
        }

        bool isMember = timelines.Segment(segment).IsOfIsland;
        int from = contacts.Count;
        for (int at = isMember ? timelines.Carried.First(segment) : TimelineStore.None; at != TimelineStore.None; at = timelines.Carried.Next(at))
        {
            contacts.Add(timelines.Carried.At(at));
        }

        pieces.Add(new Piece
        {
            Centre = isMember ? timelines.Carried.CentreOf(segment) : default,
            Still = isMember ? timelines.Carried.StillSince(segment) : default,
            FromContact = from,
            ContactCount = contacts.Count - from,
            Slot = slot,
            Key = timelines.Key(segment),
            Segment = timelines.Segment(segment),
            Dense = timelines.Dense(segment),
            Hold = timelines.HoldOf(segment),
            Spin = timelines.SpinOf(segment),
            Filter = timelines.Extras.Filter(segment),
            Later = bodies[n].Earliest,
        });
        bodies[n] = (slot, pieces.Count - 1);
        IsWhole = pieces.Count <= Most;
    }

    /// <summary>
    /// Whether after everything up to and including <paramref name="time"/> each body that was touched is on the very piece of path that it
    /// was on before.
    /// </summary>
    /// <param name="timelines">The paths as they are now.</param>
    /// <param name="time">An instant of which the heal has done all.</param>
    /// <remarks>O(1) as a rule: the body that was on another path the last time is asked first.</remarks>
    internal bool HaveReconverged(TimelineStore timelines, SimTime time)
    {
        for (int n = 0; n < bodies.Count; n++)
        {
            int at = (n + differing) % bodies.Count;
            if (!HasReconverged(timelines, bodies[at].Slot, bodies[at].Earliest, time))
            {
                differing = at;
                return false;
            }
        }

        return true;
    }

    /// <summary>Puts back the segments cut after <paramref name="time"/>; each body continues from where it is now.</summary>
    internal void PutBack(TimelineStore timelines, SimTime time, BodyTable table)
    {
        order.Clear();
        for (int i = 0; i < pieces.Count; i++)
        {
            if (pieces[i].Key.Time > time)
            {
                order.Add(i);
            }
        }

        byKey ??= CompareKeys;
        order.Sort(byKey);
        for (int from = 0; from < order.Count;)
        {
            EventKey key = pieces[order[from]].Key;
            int count = 0;
            for (; from < order.Count && pieces[order[from]].Key == key; from++)
            {
                Piece piece = pieces[order[from]];
                timelines.Extras.OpenWith(piece.Filter);
                timelines.Append(piece.Slot, table.Id(piece.Slot), piece.Key, piece.Segment, piece.Dense, piece.Hold, piece.Spin);
                PutBackContacts(timelines, piece, table.Id(piece.Slot));
                if (count == joined.Length)
                {
                    Array.Resize(ref joined, Math.Max(4, count * 2));
                }

                joined[count++] = piece.Slot;
            }

            if (count > 1)
            {
                timelines.Join(joined.AsSpan(0, count)); // a key is that of no other event
            }
        }
    }

    private int CompareKeys(int a, int b)
    {
        int compared = EventKey.Compare(pieces[a].Key, pieces[b].Key);
        return compared != 0 ? compared : pieces[a].Slot.CompareTo(pieces[b].Slot);
    }

    private bool HasReconverged(TimelineStore timelines, int slot, int earliest, SimTime time)
    {
        int old = None;
        for (int piece = earliest; piece != None && pieces[piece].Key.Time <= time; piece = pieces[piece].Later)
        {
            old = piece;
        }

        int last = timelines.Last(slot);
        if (old == None)
        {
            return timelines.Serial(last) <= LastSerial; // it was, and is, on what the heal has left of its path
        }

        return IsSamePath(timelines, last, pieces[old]) && HasSameFilter(timelines, last, pieces[old]) && CarriesTheSame(timelines, last, pieces[old]);
    }

    /// <summary>Whether a segment equals a copied path, apart from what it carries.</summary>
    private protected virtual bool IsSamePath(TimelineStore timelines, int segment, in Piece piece) => timelines.Key(segment) == piece.Key
        && timelines.Segment(segment).IsSameAs(piece.Segment)
        && (!timelines.Segment(segment).IsDense || timelines.Dense(segment).IsSameAs(piece.Dense))
        && timelines.HoldOf(segment) == piece.Hold
        && timelines.SpinOf(segment).IsSameAs(piece.Spin);

    /// <summary>Whether the body has on a segment the filter that it had on a piece.</summary>
    private protected virtual bool HasSameFilter(TimelineStore timelines, int segment, in Piece piece) =>
        timelines.Extras.Filter(segment) == piece.Filter;

    /// <summary>Whether a segment, on the same path, carries the very contacts from step to step that a piece did.</summary>
    private protected virtual bool CarriesTheSame(TimelineStore timelines, int segment, in Piece piece)
    {
        if (!piece.Segment.IsOfIsland)
        {
            return true;
        }

        bool isSame = timelines.Carried.CentreOf(segment) == piece.Centre && timelines.Carried.StillSince(segment) == piece.Still;
        int n = 0;
        int at = timelines.Carried.First(segment);
        for (; at != TimelineStore.None && isSame; at = timelines.Carried.Next(at))
        {
            isSame = n < piece.ContactCount && timelines.Carried.At(at).Equals(contacts[piece.FromContact + n++]);
        }

        return isSame && n == piece.ContactCount;
    }

    private void PutBackContacts(TimelineStore timelines, in Piece piece, BodyId body)
    {
        if (!piece.Segment.IsOfIsland)
        {
            return;
        }

        int segment = timelines.Last(piece.Slot);
        timelines.BeginMember(segment, piece.Centre, piece.Still);
        for (int n = 0; n < piece.ContactCount; n++)
        {
            timelines.Carried.Add(segment, contacts[piece.FromContact + n]);
        }

        timelines.EndMember(segment, body);
    }

    /// <summary>A segment that was cut, with all that belongs to it.</summary>
    private protected struct Piece
    {
        internal int Slot;
        internal int Later; // the body's next piece, or none
        internal EventKey Key;
        internal MotionSegment Segment;
        internal DenseOutput Dense;
        internal Hold Hold;
        internal Spin Spin;
        internal CollisionFilter Filter;
        internal SimTime Centre;
        internal SimTime Still;
        internal int FromContact;
        internal int ContactCount;
    }
}
