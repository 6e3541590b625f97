using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// Keeps account of what is predicted of a world, such as contacts, crossings, lost bodies and what rules tell: each is reported as predicted, as
/// moved whenever a late event changes it, and then as confirmed when nothing can change it any more, or as retracted when nothing can bring it
/// back.
/// </summary>
/// <remarks>For the simulation's thread, apart from <see cref="TryRead"/> and <see cref="Lost"/>.</remarks>
internal sealed class NoticeLedger<T>
    where T : struct, INotice<T>
{
    private const int MinCapacity = 16;
    private const int FewChanges = 1024;

    private static readonly Comparison<NoticePairing<T>.Candidate> byPlace = static (a, b) => a.Place.CompareTo(b.Place);

    private readonly NoticeQueue<T> queue;
    private readonly List<T> tail = new(); // what is known, while it is merged with the changes
    private List<Change> changes = new(); // since the last step that was reported, in the order in which they came
    private List<Change> spare = new();
    private readonly List<T> standing = new(); // is to happen and not confirmed, in order
    private readonly List<T> doubtful = new(); // was taken out by a heal, and may come again
    private readonly NoticePairing<T> pairing;
    private int confirmed; // the number of those standing at the front that have been confirmed
    private int settledChanges; // how many changes were left when they were last put together
    private long number;
    private long lost;
    private bool isFollowing;
    private SimTime begun = SimTime.MinValue; // the world that is followed
    private long lastOfFormer; // the number of the last notice of the world before it

    /// <summary>An account of nothing yet.</summary>
    /// <param name="capacity">How many notices may wait to be read.</param>
    /// <param name="pairing">Finds what has only moved; of this account alone.</param>
    /// <exception cref="ArgumentOutOfRangeException">It is out of its range.</exception>
    internal NoticeLedger(int capacity, NoticePairing<T> pairing)
    {
        if (capacity is < MinCapacity or > ContactNotices.MaxCapacity)
        {
            throw new ArgumentOutOfRangeException(nameof(capacity), capacity, $"From {MinCapacity} to {ContactNotices.MaxCapacity} notices may wait to be read.");
        }

        queue = new NoticeQueue<T>(capacity);
        this.pairing = pairing;
    }

    /// <summary>Raised for every notice, none left out.</summary>
    internal event Action<T>? Noticed;

    /// <summary>How many notices may wait to be read.</summary>
    internal int Capacity => queue.Capacity;

    /// <summary>How many notices found no room. From any thread.</summary>
    internal long Lost => Volatile.Read(ref lost);

    /// <summary>How many are predicted and neither confirmed nor retracted.</summary>
    internal int Pending => standing.Count - confirmed + doubtful.Count;

    /// <summary>The next notice, in order; for one thread only, the game's.</summary>
    internal bool TryRead(out T notice) => queue.TryRead(out notice);

    /// <summary>Something is found that is to happen.</summary>
    internal void Made(in T notice) => Note(new Change(changes.Count, false, notice.Key, notice));

    /// <summary>All that was to happen at a key is undone.</summary>
    internal void Cut(in EventKey key) => Note(new Change(changes.Count, true, key, default));

    /// <summary>All that was to happen at a key or later is undone, confirmed ones apart. Between two steps.</summary>
    internal void CutFrom(in EventKey key)
    {
        for (int n = FirstFrom(key); n < standing.Count; n++)
        {
            if (n == confirmed || standing[n - 1].Key != standing[n].Key)
            {
                Cut(standing[n].Key);
            }
        }
    }

    /// <summary>Takes one world on, once.</summary>
    /// <exception cref="InvalidOperationException">It follows a world already.</exception>
    internal void Follow(string what)
    {
        if (isFollowing)
        {
            throw new InvalidOperationException($"These {what} notices follow a world already; each world needs its own.");
        }

        isFollowing = true;
    }

    /// <summary>
    /// Lets go of a world that another takes the place of: what it predicted and did not confirm is in doubt until that one has it too.
    /// </summary>
    internal void Restart()
    {
        changes.Clear();
        settledChanges = 0;
        for (; confirmed < standing.Count; confirmed++)
        {
            doubtful.Add(Emit(NoticeKind.InDoubt, standing[confirmed]));
        }

        standing.Clear();
        confirmed = 0;
        isFollowing = false;
    }

    /// <summary>The world that it follows begins there: of what lies before, nobody can say here whether it happened.</summary>
    internal void Begin(SimTime from)
    {
        begun = from;
        lastOfFormer = number;
        GiveUp(from, SimDuration.Zero);
    }

    /// <summary>
    /// Reports what a step changed and what can no longer change. While a heal is under way it waits: most of what a heal undoes it makes
    /// again.
    /// </summary>
    internal void Tell(Simulation simulation)
    {
        if (simulation.Engine.Rollback.IsActive)
        {
            return;
        }

        Merge();
        while (confirmed < standing.Count && standing[confirmed].Key.Time < simulation.HistoryEdge)
        {
            Emit(NoticeKind.Confirmed, standing[confirmed++]);
        }

        GiveUp(simulation.HistoryEdge, pairing.Within); // all that it could have moved to lies before the edge
        if (confirmed > FewChanges && confirmed > standing.Count / 2)
        {
            standing.RemoveRange(0, confirmed);
            confirmed = 0;
        }
    }

    /// <summary>
    /// When a world that forgets by itself has the next to be confirmed; <see cref="SimTime.MaxValue"/> if none waits for that.
    /// </summary>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead)
    {
        if (Pending == 0 || history > SimDuration.FromSeconds(1 << 20))
        {
            return SimTime.MaxValue; // the owner that forgets for it has it step
        }

        SimTime last = confirmed < standing.Count ? standing[confirmed].Key.Time : SimTime.MaxValue;
        foreach (T known in doubtful)
        {
            last = SimTime.Min(last, known.Key.Time + pairing.Within);
        }

        return last + history - lookAhead + SimDuration.OneTick;
    }

    private void Note(in Change change)
    {
        changes.Add(change);
        if (changes.Count > FewChanges + (2 * settledChanges))
        {
            PutTogether(); // a heal that is long under way: of each key only what came last matters
        }
    }

    /// <summary>
    /// Leaves of the changes of each key whether it was cut, and what was made after that; in the order of the keys.
    /// </summary>
    private void PutTogether()
    {
        changes.Sort(static (a, b) =>
        {
            int byKey = EventKey.Compare(a.Key, b.Key);
            return byKey != 0 ? byKey : a.Place.CompareTo(b.Place);
        });
        spare.Clear();
        for (int from = 0; from < changes.Count;)
        {
            int end = from;
            int lastCut = -1;
            for (; end < changes.Count && changes[end].Key == changes[from].Key; end++)
            {
                lastCut = changes[end].IsCut ? end : lastCut;
            }

            for (int i = lastCut < 0 ? from : lastCut; i < end; i++)
            {
                spare.Add(new Change(spare.Count, changes[i].IsCut, changes[i].Key, changes[i].Notice));
            }

            from = end;
        }

        (changes, spare) = (spare, changes);
        settledChanges = changes.Count;
    }

    /// <summary>Merges the changes into what is known, and reports the difference: what moved, what is new, and what is in doubt.</summary>
    private void Merge()
    {
        if (changes.Count == 0)
        {
            return;
        }

        PutTogether();
        int from = FirstFrom(changes[0].Key);
        tail.Clear();
        for (int i = from; i < standing.Count; i++)
        {
            tail.Add(standing[i]);
        }

        standing.RemoveRange(from, standing.Count - from);
        int old = 0;
        for (int at = 0; at < changes.Count;)
        {
            EventKey key = changes[at].Key;
            while (old < tail.Count && EventKey.Compare(tail[old].Key, key) < 0)
            {
                standing.Add(tail[old++]);
            }

            at += changes[at].IsCut ? 1 : 0;

            // What a key had is made again only after it was cut. So this compares the old with the new; both are in order.
            while ((old < tail.Count && tail[old].Key == key) || (at < changes.Count && changes[at].Key == key))
            {
                bool hasOld = old < tail.Count && tail[old].Key == key;
                bool hasNew = at < changes.Count && changes[at].Key == key;
                int compared = !hasOld ? 1 : !hasNew ? -1 : tail[old].CompareWith(changes[at].Notice);
                if (compared == 0 && tail[old].IsSameAs(changes[at].Notice))
                {
                    standing.Add(tail[old++]);
                    at++;
                }
                else if (compared <= 0)
                {
                    pairing.Gone.Add(new NoticePairing<T>.Candidate(tail[old++], doubtful.Count + pairing.Gone.Count));
                }
                else
                {
                    pairing.Made.Add(new NoticePairing<T>.Candidate(changes[at].Notice, standing.Count));
                    standing.Add(changes[at++].Notice);
                }
            }
        }

        for (; old < tail.Count; old++)
        {
            standing.Add(tail[old]);
        }

        changes.Clear();
        settledChanges = 0;
        TellDifference();
    }

    /// <summary>Reports what a merge found to have been taken out and put in.</summary>
    private void TellDifference()
    {
        int doubted = doubtful.Count;
        if (pairing.Made.Count > 0)
        {
            for (int n = 0; n < doubted; n++)
            {
                pairing.Gone.Add(new NoticePairing<T>.Candidate(doubtful[n], n));
            }

            if (pairing.Gone.Count > 0)
            {
                pairing.Pair();
            }

            doubtful.Clear();
            pairing.Made.Sort(byPlace);
        }

        foreach (NoticePairing<T>.Candidate made in pairing.Made)
        {
            standing[made.Place] = made.Partner == NoticePairing<T>.None ? Emit(NoticeKind.Predicted, made.Notice)
                : Emit(NoticeKind.Moved, made.Notice, pairing.Gone[made.Partner].Notice);
        }

        pairing.Gone.Sort(byPlace);
        foreach (NoticePairing<T>.Candidate gone in pairing.Gone)
        {
            if (gone.Partner == NoticePairing<T>.None)
            {
                doubtful.Add(gone.Place < doubted ? gone.Notice : Emit(NoticeKind.InDoubt, gone.Notice));
            }
        }

        pairing.Made.Clear();
        pairing.Gone.Clear();
    }

    /// <summary>
    /// Reports of what is in doubt, and lies before an instant by more than some time, that it is given up: it does not happen, or a former
    /// world predicted it, and it may have moved to before this one began, where nobody knows.
    /// </summary>
    private void GiveUp(SimTime before, SimDuration by)
    {
        int kept = 0;
        for (int n = 0; n < doubtful.Count; n++)
        {
            T known = doubtful[n];
            if (known.Key.Time < before && before - known.Key.Time > by)
            {
                bool mayHaveMoved = known.Id <= lastOfFormer && known.Key.Time < begun + pairing.Within;
                Emit(mayHaveMoved ? NoticeKind.Unresolved : NoticeKind.Retracted, known);
            }
            else
            {
                doubtful[kept++] = known;
            }
        }

        doubtful.RemoveRange(kept, doubtful.Count - kept);
    }

    /// <summary>
    /// The place in what is known of the first of that key or a later one; confirmed ones come first.
    /// </summary>
    private int FirstFrom(in EventKey key)
    {
        int low = confirmed;
        int high = standing.Count;
        while (low < high)
        {
            int middle = (low + high) >> 1;
            if (EventKey.Compare(standing[middle].Key, key) < 0)
            {
                low = middle + 1;
            }
            else
            {
                high = middle;
            }
        }

        return low;
    }

    private T Emit(NoticeKind kind, in T notice) => Emit(kind, notice, notice);

    /// <summary>Reports a notice of what was told before, except for a prediction.</summary>
    private T Emit(NoticeKind kind, in T notice, in T told)
    {
        number++;
        T stamped = notice.As(new NoticeStamp(kind, number, kind == NoticeKind.Predicted ? number : told.Id, told.Key.Time));
        Noticed?.Invoke(stamped);
        bool isLast = kind is NoticeKind.Confirmed or NoticeKind.Retracted or NoticeKind.Unresolved;
        if (!queue.TryWrite(stamped, isLast ? queue.Capacity : queue.Capacity / 2))
        {
            Volatile.Write(ref lost, lost + 1); // no other thread writes it
        }

        return stamped;
    }

    /// <summary>What was made, or that all of a key was cut.</summary>
    private readonly struct Change
    {
        internal Change(int place, bool isCut, in EventKey key, in T notice)
        {
            Place = place;
            IsCut = isCut;
            Key = key;
            Notice = notice;
        }

        /// <summary>Which came first.</summary>
        internal int Place { get; }

        internal bool IsCut { get; }

        internal EventKey Key { get; }

        internal T Notice { get; }
    }
}
