using System;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>
/// Reports crossings of sensors to a game: each is predicted, moved by late events, then confirmed when nothing can change it any more, or
/// retracted.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens. In a scene without sensors it never reports anything.</para>
/// <para>The rules are those of <see cref="ContactNotices"/>: a crossing that a rewind undid and re-simulation made again unchanged gives no
/// notice; it is the same, moved, if body, sensor and direction are the same; each predicted crossing is in the end either retracted or confirmed, once; confirmed ones come in ascending order of their keys,
/// the same on all peers from where each of them began. A body that is inside from the start of a world enters then; one that joins a
/// session later is told of what comes after its copy.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same notices with
/// <see cref="TryRead"/>, without a lock.</para>
/// </remarks>
/// <example>
/// A score that counts only confirmed crossings:
/// <code>
/// CrossingNotices crossings = new();
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Crossings = crossings, Unprotected = true });
/// int goal = scene.SensorNamed("goal");
/// int score = 0;
///
/// // each frame
/// while (crossings.TryRead(out CrossingNotice crossing))
/// {
///     score += crossing.Kind == NoticeKind.Confirmed &amp;&amp; crossing.Sensor == goal &amp;&amp; crossing.Entered ? 1 : 0;
/// }
/// </code>
/// </example>
public sealed class CrossingNotices : ICrossingObserver
{
    private readonly NoticeLedger<CrossingNotice> ledger;

    /// <summary>Creates the notices for the crossings of one world, which is given them.</summary>
    /// <param name="capacity">How many notices may wait to be read, 16 to <see cref="ContactNotices.MaxCapacity"/>, default
    /// <see cref="ContactNotices.DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is out of its range.</exception>
    public CrossingNotices(int capacity = ContactNotices.DefaultCapacity)
        : this(capacity, new NoticePairing<CrossingNotice>())
    {
    }

    internal CrossingNotices(int capacity, NoticePairing<CrossingNotice> pairing) =>
        ledger = new NoticeLedger<CrossingNotice>(capacity, pairing);

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<CrossingNotice>? Noticed
    {
        add => ledger.Noticed += value;
        remove => ledger.Noticed -= value;
    }

    /// <summary>How many notices may wait to be read.</summary>
    public int Capacity => ledger.Capacity;

    /// <summary>
    /// The number of notices that <see cref="TryRead"/> will never return, because too many waited; each is a gap in
    /// <see cref="CrossingNotice.Number"/>. <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => ledger.Lost;

    /// <summary>How many crossings are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => ledger.Pending;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out CrossingNotice notice) => ledger.TryRead(out notice);

    void ICrossingObserver.OnCrossing(in Crossing crossing) => ledger.Made(new CrossingNotice(crossing));

    void ICrossingObserver.OnCut(in Crossing crossing) => ledger.Cut(crossing.Key);

    /// <inheritdoc cref="NoticeLedger{T}.Follow"/>
    internal void Follow() => ledger.Follow("crossing");

    /// <inheritdoc cref="NoticeLedger{T}.Restart"/>
    internal void Restart() => ledger.Restart();

    /// <inheritdoc cref="NoticeLedger{T}.Begin"/>
    internal void Begin(SimTime from) => ledger.Begin(from);

    /// <inheritdoc cref="NoticeLedger{T}.Tell"/>
    internal void Tell(Simulation simulation) => ledger.Tell(simulation);

    /// <inheritdoc cref="NoticeLedger{T}.NextDue"/>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead) => ledger.NextDue(history, lookAhead);
}
