using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>
/// Reports contacts to a game: each is predicted, then confirmed when nothing can change it any more, or retracted after a late event.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens.</para>
/// <para>Notices are made after each step of the world. A contact that a rewind undid and re-simulation made again unchanged gives no
/// notice: nothing is retracted and then predicted unchanged. Each predicted contact is in the end either retracted or confirmed, once.
/// Confirmed ones come in ascending order of their keys, each once, and are the same on all peers from where each of them began. A contact
/// that is not committed when a world ends is never confirmed. Confirmation comes as late as a late event may: the history of the world or
/// session, and up to as long as a session at rest is silent.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same notices with
/// <see cref="TryRead"/>, without a lock.</para>
/// <para>Memory: the queue, and some 150 bytes for each contact that is neither confirmed nor retracted. These are no more than the world's
/// own segments, which the world bounds.</para>
/// </remarks>
/// <example>
/// A score that counts only confirmed contacts:
/// <code>
/// ContactNotices contacts = new(minClosingSpeed: 0.2); // m/s
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Contacts = contacts });
/// int score = 0;
///
/// // each frame
/// while (contacts.TryRead(out ContactNotice contact))
/// {
///     score += contact.Kind == ContactNoticeKind.Confirmed ? 1 : 0;
/// }
/// </code>
/// </example>
public sealed class ContactNotices : IImpactObserver
{
    /// <summary>
    /// The default least closing speed, 0.05 m/s: ten times that of the least bounces that are followed on other bodies.
    /// </summary>
    public const double DefaultMinClosingSpeed = 0.05;

    /// <summary>The default limit on notices that wait to be read.</summary>
    public const int DefaultCapacity = 4096;

    /// <summary>The largest queue.</summary>
    public const int MaxCapacity = 1 << 20;

    private const int MinCapacity = 16;
    private const int FewChanges = 1024;

    private readonly NoticeQueue<ContactNotice> queue;
    private readonly List<ContactNotice> tail = new(); // the known contacts, while they are merged with the changes
    private List<Change> changes = new(); // since the last step that was reported, in the order in which they came
    private List<Change> spare = new();
    private readonly List<ContactNotice> standing = new(); // predicted and neither confirmed nor retracted, in order
    private int confirmed; // the number of these at the front that have been confirmed
    private int settledChanges; // how many changes were left when they were last put together
    private long number;
    private long lost;
    private bool isFollowing;

    /// <summary>Creates the notices for the contacts of one world, which is given them.</summary>
    /// <param name="minClosingSpeed">Slower contacts are not reported, in m/s; at least zero, default <see cref="DefaultMinClosingSpeed"/>.
    /// With zero a body that lies on another is reported a thousand times a second. Peers that are to get the same notices need the same
    /// value.</param>
    /// <param name="capacity">How many notices may wait to be read, 16 to <see cref="MaxCapacity"/>, default
    /// <see cref="DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    public ContactNotices(double minClosingSpeed = DefaultMinClosingSpeed, int capacity = DefaultCapacity)
    {
        if (!(minClosingSpeed >= 0) || double.IsInfinity(minClosingSpeed))
        {
            throw new ArgumentOutOfRangeException(nameof(minClosingSpeed), minClosingSpeed, "The least closing speed is a finite number of m/s, at"
                + " least zero.");
        }

        if (capacity is < MinCapacity or > MaxCapacity)
        {
            throw new ArgumentOutOfRangeException(nameof(capacity), capacity, $"From {MinCapacity} to {MaxCapacity} notices may wait to be read.");
        }

        MinClosingSpeed = minClosingSpeed;
        queue = new NoticeQueue<ContactNotice>(capacity);
    }

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<ContactNotice>? Noticed;

    /// <summary>Slower contacts are not reported, in m/s.</summary>
    public double MinClosingSpeed { get; }

    /// <summary>How many notices may wait to be read.</summary>
    public int Capacity => queue.Capacity;

    /// <summary>
    /// The number of notices that <see cref="TryRead"/> will never return, because too many waited. Predictions take at most half of the
    /// queue; other notices that find no room are left out too, each with a gap in <see cref="ContactNotice.Number"/>.
    /// <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => Volatile.Read(ref lost);

    /// <summary>How many contacts are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => standing.Count - confirmed;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out ContactNotice notice) => queue.TryRead(out notice);

    void IImpactObserver.OnContact(in EventKey impact, in ImpactContact contact)
    {
        if (contact.ClosingSpeed >= MinClosingSpeed)
        {
            Note(new Change(changes.Count, false, new ContactNotice(ContactNoticeKind.Predicted, 0, impact, contact)));
        }
    }

    void IImpactObserver.OnCut(in EventKey impact) => Note(new Change(changes.Count, true, new ContactNotice(ContactNoticeKind.Retracted, 0, impact, default)));

    /// <summary>Takes one world on, once.</summary>
    /// <exception cref="InvalidOperationException">It follows a world already.</exception>
    internal void Follow()
    {
        if (isFollowing)
        {
            throw new InvalidOperationException("These contact notices follow a world already; each world needs its own.");
        }

        isFollowing = true;
    }

    /// <summary>Lets go of a world that another takes the place of: what it predicted and did not confirm is retracted.</summary>
    internal void Restart()
    {
        changes.Clear();
        settledChanges = 0;
        for (; confirmed < standing.Count; confirmed++)
        {
            Emit(ContactNoticeKind.Retracted, standing[confirmed]);
        }

        standing.Clear();
        confirmed = 0;
        isFollowing = false;
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
        while (confirmed < standing.Count && standing[confirmed].Time < simulation.HistoryEdge)
        {
            Emit(ContactNoticeKind.Confirmed, standing[confirmed++]);
        }

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

        return standing[confirmed].Time + history - lookAhead + SimDuration.OneTick;
    }

    private void Note(in Change change)
    {
        changes.Add(change);
        if (changes.Count > FewChanges + (2 * settledChanges))
        {
            PutTogether(); // a heal that is long under way: of each impact only what came last matters
        }
    }

    /// <summary>
    /// Leaves of the changes of each impact whether it was cut, and what was made after that; in the order of the impacts.
    /// </summary>
    private void PutTogether()
    {
        changes.Sort(static (a, b) =>
        {
            int byKey = EventKey.Compare(a.Contact.Key, b.Contact.Key);
            return byKey != 0 ? byKey : a.Place.CompareTo(b.Place);
        });
        spare.Clear();
        for (int from = 0; from < changes.Count;)
        {
            int end = from;
            int lastCut = -1;
            for (; end < changes.Count && changes[end].Contact.Key == changes[from].Contact.Key; end++)
            {
                lastCut = changes[end].IsCut ? end : lastCut;
            }

            for (int i = lastCut < 0 ? from : lastCut; i < end; i++)
            {
                spare.Add(new Change(spare.Count, changes[i].IsCut, changes[i].Contact));
            }

            from = end;
        }

        (changes, spare) = (spare, changes);
        settledChanges = changes.Count;
    }

    /// <summary>Merges the changes into the known contacts, and reports the difference.</summary>
    private void Merge()
    {
        if (changes.Count == 0)
        {
            return;
        }

        PutTogether();
        int from = FirstFrom(changes[0].Contact.Key);
        tail.Clear();
        for (int i = from; i < standing.Count; i++)
        {
            tail.Add(standing[i]);
        }

        standing.RemoveRange(from, standing.Count - from);
        int old = 0;
        for (int at = 0; at < changes.Count;)
        {
            EventKey key = changes[at].Contact.Key;
            while (old < tail.Count && EventKey.Compare(tail[old].Key, key) < 0)
            {
                standing.Add(tail[old++]);
            }

            at += changes[at].IsCut ? 1 : 0;

            // An impact is made again only after it was cut. So this compares its old contacts with its new ones; both are in the order of
            // contacts.
            while ((old < tail.Count && tail[old].Key == key) || (at < changes.Count && changes[at].Contact.Key == key))
            {
                bool hasOld = old < tail.Count && tail[old].Key == key;
                bool hasNew = at < changes.Count && changes[at].Contact.Key == key;
                int compared = !hasOld ? 1 : !hasNew ? -1 : ContactNotice.Compare(tail[old], changes[at].Contact);
                if (compared == 0 && tail[old].IsSameContact(changes[at].Contact))
                {
                    standing.Add(tail[old++]);
                    at++;
                }
                else if (compared <= 0)
                {
                    Emit(ContactNoticeKind.Retracted, tail[old++]);
                }
                else
                {
                    standing.Add(changes[at].Contact);
                    Emit(ContactNoticeKind.Predicted, changes[at++].Contact);
                }
            }
        }

        for (; old < tail.Count; old++)
        {
            standing.Add(tail[old]);
        }

        changes.Clear();
        settledChanges = 0;
    }

    /// <summary>
    /// The place in the known contacts of the first contact of that impact or a later one; confirmed contacts come first.
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

    private void Emit(ContactNoticeKind kind, in ContactNotice contact)
    {
        ContactNotice notice = contact.As(kind, ++number);
        Noticed?.Invoke(notice);
        if (!queue.TryWrite(notice, kind == ContactNoticeKind.Predicted ? queue.Capacity / 2 : queue.Capacity))
        {
            Volatile.Write(ref lost, lost + 1); // no other thread writes it
        }
    }

    /// <summary>A contact of an impact that was made, or an impact that was cut.</summary>
    private readonly struct Change
    {
        internal Change(int place, bool isCut, in ContactNotice contact)
        {
            Place = place;
            IsCut = isCut;
            Contact = contact;
        }

        /// <summary>Which came first.</summary>
        internal int Place { get; }

        internal bool IsCut { get; }

        internal ContactNotice Contact { get; }
    }
}
