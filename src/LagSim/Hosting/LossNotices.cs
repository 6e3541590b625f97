using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>
/// Reports to a game which bodies are lost, because their motion cannot be followed any further: each loss is predicted, moved by late
/// events, then confirmed when nothing can change it any more, or retracted.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens. Only bodies that leave the world by themselves are reported, not those that
/// a player or rules remove. Where nobody listens, or nothing is lost, it costs next to nothing.</para>
/// <para>The rules are those of <see cref="ContactNotices"/>: a loss that a rewind undid and re-simulation made again unchanged gives no
/// notice; it is the same, moved, if body and reason are the same and it is at most half a second off; each predicted loss is in the end
/// either retracted or confirmed, once; confirmed ones come in ascending order of their keys, the same on all peers from where each of them
/// began. A peer that joins a session later is told of what comes after its copy.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same notices with
/// <see cref="TryRead"/>, without a lock.</para>
/// </remarks>
/// <example>
/// A ball that is put back on the table once it is certain that it is gone:
/// <code>
/// LossNotices losses = new();
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Losses = losses, Unprotected = true });
///
/// // each frame
/// while (losses.TryRead(out LossNotice loss))
/// {
///     if (loss.Kind == NoticeKind.Confirmed)
///     {
///         _ = host.Do(PlayerAction.Spawn(new BodySpec(0.1, 1, 0.5), new Vector3D(0, 1, 0)));
///     }
/// }
/// </code>
/// </example>
public sealed class LossNotices : ILossObserver
{
    private readonly NoticeLedger<LossNotice> ledger;

    /// <summary>Creates the notices for the lost bodies of one world, which is given them.</summary>
    /// <param name="capacity">How many notices may wait to be read, 16 to <see cref="ContactNotices.MaxCapacity"/>, default
    /// <see cref="ContactNotices.DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The capacity is out of its range.</exception>
    public LossNotices(int capacity = ContactNotices.DefaultCapacity)
        : this(capacity, new NoticePairing<LossNotice>())
    {
    }

    internal LossNotices(int capacity, NoticePairing<LossNotice> pairing) =>
        ledger = new NoticeLedger<LossNotice>(capacity, pairing);

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<LossNotice>? Noticed
    {
        add => ledger.Noticed += value;
        remove => ledger.Noticed -= value;
    }

    /// <summary>How many notices may wait to be read.</summary>
    public int Capacity => ledger.Capacity;

    /// <summary>
    /// The number of notices, not of bodies, that <see cref="TryRead"/> will never return, because too many waited; each is a gap in
    /// <see cref="LossNotice.Number"/>. <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => ledger.Lost;

    /// <summary>How many losses are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => ledger.Pending;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out LossNotice notice) => ledger.TryRead(out notice);

    void ILossObserver.OnLost(in EventKey loss, in MotionSegment last) => ledger.Made(new LossNotice(loss, last.Position, last.Velocity));

    void ILossObserver.OnCut(in EventKey loss) => ledger.Cut(loss);

    /// <inheritdoc cref="NoticeLedger{T}.Follow"/>
    internal void Follow() => ledger.Follow("loss");

    /// <inheritdoc cref="NoticeLedger{T}.Restart"/>
    internal void Restart() => ledger.Restart();

    /// <inheritdoc cref="NoticeLedger{T}.Begin"/>
    internal void Begin(SimTime from) => ledger.Begin(from);

    /// <inheritdoc cref="NoticeLedger{T}.Tell"/>
    internal void Tell(Simulation simulation) => ledger.Tell(simulation);

    /// <inheritdoc cref="NoticeLedger{T}.NextDue"/>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead) => ledger.NextDue(history, lookAhead);
}
