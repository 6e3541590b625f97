using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// Reports to a game what its rules tell (<see cref="RuleWorld.Tell"/>): each is predicted, moved by late events, then confirmed when nothing
/// can change it any more, or retracted.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens.</para>
/// <para>What a heal undoes and makes again unchanged gives nothing. What it makes again with the same code and key is moved, as contacts
/// are (<see cref="ContactNotices"/>), even if its value is another. Each predicted notice is in the end either retracted or confirmed,
/// once. Confirmed ones come in the order in which the rules told them, each once, and are the same on all peers from where each of them
/// began. One that is not committed when a world ends is never confirmed.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same with <see cref="TryRead"/>,
/// without a lock.</para>
/// </remarks>
/// <example>
/// A sound with the prediction, the score board with the confirmation:
/// <code>
/// RuleNotices notices = new();
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { RuleNotices = notices, Unprotected = true });
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

    private readonly NoticeLedger<RuleEvent> ledger;

    /// <summary>Creates the notices for the rules of one world, which is given them.</summary>
    /// <param name="capacity">How many may wait to be read, 16 to <see cref="MaxCapacity"/>, default <see cref="DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is out of its range.</exception>
    public RuleNotices(int capacity = DefaultCapacity)
        : this(capacity, new NoticePairing<RuleEvent>())
    {
    }

    internal RuleNotices(int capacity, NoticePairing<RuleEvent> pairing) => ledger = new NoticeLedger<RuleEvent>(capacity, pairing);

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<RuleEvent>? Noticed
    {
        add => ledger.Noticed += value;
        remove => ledger.Noticed -= value;
    }

    /// <summary>
    /// The number of notices that <see cref="TryRead"/> will never return, because too many waited. Uncertain ones take at most
    /// half of the queue. <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => ledger.Lost;

    /// <summary>How many notices are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => ledger.Pending;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out RuleEvent told) => ledger.TryRead(out told);

    /// <inheritdoc cref="NoticeLedger{T}.Follow"/>
    internal void Follow() => ledger.Follow("rule");

    /// <inheritdoc cref="NoticeLedger{T}.Restart"/>
    internal void Restart() => ledger.Restart();

    /// <inheritdoc cref="NoticeLedger{T}.Begin"/>
    internal void Begin(SimTime from) => ledger.Begin(from);

    /// <inheritdoc cref="NoticeLedger{T}.Tell"/>
    internal void Tell(Simulation simulation)
    {
        if (simulation.Engine.Rules is not RuleLog log || simulation.Engine.Rollback.IsActive)
        {
            return;
        }

        if (log.TryTakeChanged(out EventKey from))
        {
            ledger.CutFrom(from);
            TakeFrom(log, from);
        }

        ledger.Tell(simulation);
        log.DropBefore(simulation.HistoryEdge);
    }

    /// <inheritdoc cref="NoticeLedger{T}.NextDue"/>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead) => ledger.NextDue(history, lookAhead);

    /// <summary>
    /// Takes in what the rules tell from a key on. The calls for several contacts of one impact have one key: what they tell is counted
    /// through.
    /// </summary>
    private void TakeFrom(RuleLog log, in EventKey from)
    {
        int place = 0;
        for (int n = log.FirstFrom(from); n < log.Position; n++)
        {
            place = n > 0 && log[n - 1].Key == log[n].Key ? place : 0;
            foreach (RuleNotice notice in log[n].Notices)
            {
                ledger.Made(new RuleEvent(log[n].Key, place++, notice));
            }
        }
    }
}
