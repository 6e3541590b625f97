using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// Reports to a game what its rules tell (<see cref="RuleWorld.Tell"/>): each notice is predicted, then confirmed when nothing can change it
/// any more, or retracted after a late event.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens.</para>
/// <para>What a heal undoes and makes again unchanged gives nothing. Each predicted notice is in the end either retracted or confirmed,
/// once. Confirmed ones come in the order in which the rules told them, each once, and are the same on all peers from where each of them
/// began. One that is not committed when a world ends is never confirmed.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same with <see cref="TryRead"/>,
/// without a lock.</para>
/// </remarks>
/// <example>
/// A sound with the prediction, the score board with the confirmation:
/// <code>
/// RuleNotices notices = new();
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { RuleNotices = notices });
///
/// // each frame
/// while (notices.TryRead(out RuleEvent told))
/// {
///     goals += told.Kind == NoticeKind.Confirmed &amp;&amp; told.Notice.Code == 1 ? 1 : 0;
/// }
/// </code>
/// </example>
public sealed class RuleNotices
{
    /// <summary>The default limit on notices that wait to be read.</summary>
    public const int DefaultCapacity = 1024;

    /// <summary>The largest queue.</summary>
    public const int MaxCapacity = 1 << 20;

    private const int MinCapacity = 16;
    private const int FewConfirmed = 1024;

    private readonly NoticeQueue<RuleEvent> queue;
    private readonly List<RuleEvent> standing = new(); // predicted and neither confirmed nor retracted, in order
    private readonly List<RuleEvent> tail = new(); // those that may have changed, while they are compared
    private int confirmed; // the number of these at the front that have been confirmed
    private long number;
    private long lost;
    private bool isFollowing;

    /// <summary>Creates the notices for the rules of one world, which is given them.</summary>
    /// <param name="capacity">How many may wait to be read, 16 to <see cref="MaxCapacity"/>, default <see cref="DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is out of its range.</exception>
    public RuleNotices(int capacity = DefaultCapacity)
    {
        if (capacity is < MinCapacity or > MaxCapacity)
        {
            throw new ArgumentOutOfRangeException(nameof(capacity), capacity, $"From {MinCapacity} to {MaxCapacity} notices may wait to be read.");
        }

        queue = new NoticeQueue<RuleEvent>(capacity);
    }

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<RuleEvent>? Noticed;

    /// <summary>
    /// The number of notices that <see cref="TryRead"/> will never return, because too many waited. Predictions take at most half of the
    /// queue. <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => Volatile.Read(ref lost);

    /// <summary>How many notices are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => standing.Count - confirmed;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out RuleEvent told) => queue.TryRead(out told);

    /// <summary>Takes one world on, once.</summary>
    /// <exception cref="InvalidOperationException">It follows a world already.</exception>
    internal void Follow()
    {
        if (isFollowing)
        {
            throw new InvalidOperationException("These notices of rules follow a world already; each world needs its own.");
        }

        isFollowing = true;
    }

    /// <summary>Lets go of a world that another takes the place of: what it predicted and did not confirm is retracted.</summary>
    internal void Restart()
    {
        for (; confirmed < standing.Count; confirmed++)
        {
            Emit(NoticeKind.Retracted, standing[confirmed]);
        }

        standing.Clear();
        confirmed = 0;
        isFollowing = false;
    }

    /// <summary>Reports what a step changed and what can no longer change. While a heal is under way it waits.</summary>
    internal void Tell(Simulation simulation)
    {
        if (simulation.Engine.Rules is not RuleLog log || simulation.Engine.Rollback.IsActive)
        {
            return;
        }

        if (log.TryTakeChanged(out EventKey from))
        {
            Merge(log, from);
        }

        while (confirmed < standing.Count && standing[confirmed].Time < simulation.HistoryEdge)
        {
            Emit(NoticeKind.Confirmed, standing[confirmed++]);
        }

        if (confirmed > FewConfirmed && confirmed > standing.Count / 2)
        {
            standing.RemoveRange(0, confirmed);
            confirmed = 0;
        }

        log.DropBefore(simulation.HistoryEdge);
    }

    /// <summary>
    /// When a world that forgets by itself has the next to be confirmed; <see cref="SimTime.MaxValue"/> if none waits for that.
    /// </summary>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead) => Pending == 0 || history > SimDuration.FromSeconds(1 << 20)
        ? SimTime.MaxValue // the owner that forgets for it has it step
        : standing[confirmed].Time + history - lookAhead + SimDuration.OneTick;

    /// <summary>Compares what was told from a key on with what the rules tell now.</summary>
    private void Merge(RuleLog log, in EventKey from)
    {
        int keep = standing.Count;
        while (keep > confirmed && EventKey.Compare(standing[keep - 1].Key, from) >= 0)
        {
            keep--;
        }

        tail.Clear();
        for (int n = keep; n < standing.Count; n++)
        {
            tail.Add(standing[n]);
        }

        standing.RemoveRange(keep, standing.Count - keep);
        int old = 0;
        int place = 0;
        for (int n = log.FirstFrom(from); n < log.Position; n++)
        {
            place = n > 0 && log[n - 1].Key == log[n].Key ? place : 0;
            foreach (RuleNotice notice in log[n].Notices)
            {
                Put(new RuleEvent(NoticeKind.Predicted, 0, log[n].Key, place++, notice), ref old);
            }
        }

        for (; old < tail.Count; old++)
        {
            Emit(NoticeKind.Retracted, tail[old]);
        }
    }

    /// <summary>The rules tell this now: what they told before it, and tell no more, is retracted.</summary>
    private void Put(in RuleEvent told, ref int old)
    {
        while (old < tail.Count && RuleEvent.Compare(tail[old], told) < 0)
        {
            Emit(NoticeKind.Retracted, tail[old++]);
        }

        bool isThere = old < tail.Count && RuleEvent.Compare(tail[old], told) == 0;
        standing.Add(told);
        if (isThere && tail[old].IsSameNotice(told))
        {
            old++;
            return;
        }

        if (isThere)
        {
            Emit(NoticeKind.Retracted, tail[old++]);
        }

        Emit(NoticeKind.Predicted, told);
    }

    private void Emit(NoticeKind kind, in RuleEvent told)
    {
        RuleEvent notice = told.As(kind, ++number);
        Noticed?.Invoke(notice);
        if (!queue.TryWrite(notice, kind == NoticeKind.Predicted ? queue.Capacity / 2 : queue.Capacity))
        {
            Volatile.Write(ref lost, lost + 1); // no other thread writes it
        }
    }
}
