using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// The stretch of time around now in which a peer works: it takes events that are up to <see cref="History"/> late, and knows the world
/// <see cref="LookAhead"/> beyond now. Anything older is committed.
/// </summary>
/// <remarks>
/// <para>Immutable, safe on any thread. The history is the session's, and so the host's: whether an event is too late is validated once,
/// for all. The look-ahead and the lags are each peer's own, and no bit of the world depends on the look-ahead.</para>
/// <para>Memory: the completed events are one segment for each thing that happened to a body, kept for the history: bodies × (segments a
/// second × history + 1) × 184 bytes, and at most a quarter more. Once any path of the world is of a degree above two (an integrator's, a
/// closed form's of other forces, an island's, a hand's), every segment takes 80 more; once any body turns, 48 more; once any is held, 40
/// more; once any two are in an island, 4 more: 356 at the most.</para>
/// </remarks>
public sealed class LatencyCompensationWindow
{
    /// <summary>The shortest history: 50 ms.</summary>
    public static readonly SimDuration MinHistory = SimDuration.FromMilliseconds(50);

    /// <summary>
    /// The default history: 1 s, two hops of most links there are. It has to be fixed before the first event, so before anything is
    /// measured.
    /// </summary>
    public static readonly SimDuration DefaultHistory = SimDuration.FromSeconds(1);

    /// <summary>The longest history: 5 s.</summary>
    public static readonly SimDuration MaxHistory = SimDuration.FromSeconds(5);

    /// <summary>The history that <see cref="HistoryFor"/> gives at least, however fast the links are: 250 ms.</summary>
    public static readonly SimDuration MinMeasuredHistory = SimDuration.FromMilliseconds(250);

    /// <summary>The default look-ahead: two frames of a sixtieth of a second.</summary>
    public static readonly SimDuration DefaultLookAhead = SimDuration.FromSeconds(2.0 / 60.0);

    /// <summary>The longest look-ahead: 1 s.</summary>
    public static readonly SimDuration MaxLookAhead = SimDuration.FromSeconds(1);

    private const double MeasuredQuantile = 0.999;

    private readonly SimDuration[] lags; // by kind of event

    /// <summary>A window without local lag; see <see cref="WithLocalLag"/>.</summary>
    /// <param name="history">How late an event may come and still be healed, <see cref="MinHistory"/> to <see cref="MaxHistory"/>, default
    /// <see cref="DefaultHistory"/>; at least the worst expected delay (two hops, from player to host and from host to player), the clocks'
    /// error and the interval at which is sent.</param>
    /// <param name="lookAhead">How far beyond now the world is simulated, above zero to <see cref="MaxLookAhead"/>, default
    /// <see cref="DefaultLookAhead"/>. It covers the interpolation of frames and spikes of other work; since every peer simulates
    /// everything it needs to cover no network.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    public LatencyCompensationWindow(SimDuration? history = null, SimDuration? lookAhead = null)
        : this(history ?? DefaultHistory, lookAhead ?? DefaultLookAhead, new SimDuration[EventKinds.OfPlayersCount])
    {
    }

    private LatencyCompensationWindow(SimDuration history, SimDuration lookAhead, SimDuration[] lags)
    {
        if (history < MinHistory || history > MaxHistory)
        {
            throw new ArgumentOutOfRangeException(nameof(history), history.ToShortString(), $"The history must lie between {MinHistory.ToShortString()} and"
                + $" {MaxHistory.ToShortString()}.");
        }

        if (lookAhead <= SimDuration.Zero || lookAhead > MaxLookAhead)
        {
            throw new ArgumentOutOfRangeException(nameof(lookAhead), lookAhead.ToShortString(), $"The look-ahead must be above zero and at most"
                + $" {MaxLookAhead.ToShortString()}.");
        }

        History = history;
        LookAhead = lookAhead;
        this.lags = lags;
        foreach (SimDuration lag in lags)
        {
            ThrowIfNot(lag);
        }
    }

    /// <summary>How late an event may come and still be healed.</summary>
    public SimDuration History { get; }

    /// <summary>How far beyond now the world is simulated.</summary>
    public SimDuration LookAhead { get; }

    /// <summary>The same window with another history.</summary>
    /// <exception cref="ArgumentOutOfRangeException">It is out of its range, or too short for a lag.</exception>
    public LatencyCompensationWindow WithHistory(SimDuration history) => new(history, LookAhead, lags);

    /// <summary>The same window with another look-ahead.</summary>
    /// <exception cref="ArgumentOutOfRangeException">It is out of its range, or shorter than a lag.</exception>
    public LatencyCompensationWindow WithLookAhead(SimDuration lookAhead) => new(History, lookAhead, lags);

    /// <summary>The same window with a local lag for this peer's actions of one kind.</summary>
    /// <param name="kind">The kind. Grab, keyframe and release of a hand should have the same lag, or they overtake each other.</param>
    /// <param name="lag">How much later than the action it takes effect, here as on other peers; from zero, the default, to the look-ahead,
    /// and no more than half the history. Above the delay of the links no peer ever has to heal it, and the player sees it that much
    /// later.</param>
    /// <exception cref="ArgumentOutOfRangeException">The kind is not a player's, or the lag is out of its range.</exception>
    public LatencyCompensationWindow WithLocalLag(EventKind kind, SimDuration lag)
    {
        if (!EventKinds.IsOfPlayers(kind))
        {
            throw new ArgumentOutOfRangeException(
                nameof(kind), kind, "A local lag is that of what players do: a spawn, a teleport, a set velocity, an impulse, a grab, a keyframe of a hand, a release, a"
                    + " removal, a change of a filter, a command.");
        }

        SimDuration[] changed = (SimDuration[])lags.Clone();
        changed[kind - EventKind.Spawn] = lag;
        return new LatencyCompensationWindow(History, LookAhead, changed);
    }

    /// <summary>The local lag of actions of this kind; zero for a kind that players do not cause.</summary>
    public SimDuration LocalLag(EventKind kind) => EventKinds.IsOfPlayers(kind) ? lags[kind - EventKind.Spawn] : SimDuration.Zero;

    /// <summary>
    /// The history that would have served, from how late events were that came: the 99.9th percentile of it, but
    /// <see cref="MinMeasuredHistory"/> at least and <see cref="MaxHistory"/> at most.
    /// </summary>
    /// <param name="lateness">By how much each event came after its stamp, negative if before; as a session counts it. At least
    /// one.</param>
    /// <exception cref="ArgumentException">Nothing was measured.</exception>
    /// <remarks>
    /// The percentile is that of the sorted values at rank ⌈0.999 n⌉, so it was measured itself; of fewer than a thousand it is the
    /// largest.
    /// </remarks>
    public static SimDuration HistoryFor(IReadOnlyCollection<SimDuration> lateness)
    {
        if (lateness is null || lateness.Count == 0)
        {
            throw new ArgumentException("How late events come must have been measured at least once.", nameof(lateness));
        }

        SimDuration[] sorted = new SimDuration[lateness.Count];
        int count = 0;
        foreach (SimDuration one in lateness)
        {
            sorted[count++] = one >= SimDuration.Zero ? one
                : throw new ArgumentOutOfRangeException(nameof(lateness), one.ToShortString(), "An event comes at its time or later: zero or more.");
        }

        Array.Sort(sorted);
        int rank = count - (int)(count * (1 - MeasuredQuantile)) - 1;
        SimDuration measured = sorted[rank];
        return measured < MinMeasuredHistory ? MinMeasuredHistory : measured > MaxHistory ? MaxHistory : measured;
    }

    private void ThrowIfNot(SimDuration lag)
    {
        SimDuration half = History / 2;
        SimDuration most = LookAhead < half ? LookAhead : half;
        if (lag < SimDuration.Zero || lag > most)
        {
            throw new ArgumentOutOfRangeException(nameof(lag), lag.ToShortString(), $"A local lag must lie between 0 s and {most.ToShortString()}, the lesser"
                + " of the look-ahead and half the history.");
        }
    }
}
