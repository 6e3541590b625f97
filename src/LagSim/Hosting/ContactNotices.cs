using System;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>
/// Reports contacts to a game: each is predicted, moved by late events, then confirmed when nothing can change it any more, or retracted.
/// </summary>
/// <remarks>
/// <para>Made by the game and given to the one world it is to follow: to a <see cref="SimulationHost"/> or <see cref="LiveWorld"/>, or with
/// the options of a session. It changes no bit of what happens.</para>
/// <para>Notices are made after each step of the world. A contact that a rewind undid and re-simulation made again unchanged gives no
/// notice. One that came again at another instant, or otherwise, is moved: it keeps its <see cref="ContactNotice.Id"/>. It is the same if
/// body and body, or body and surface, are, and it is at most half a second off; of several as many as possible are taken to be the same,
/// in their order, and then the nearest. One that did not come again is in doubt until it is moved after all, or nothing can bring it back.
/// </para>
/// <para>Each predicted contact is in the end either retracted or confirmed, once. Confirmed ones come in ascending order of their keys,
/// each once, and are the same on all peers from where each of them began. A contact that is not committed when a world ends is never
/// confirmed. Confirmation comes as late as a late event may: the history of the world or session, and up to as long as a session at rest
/// is silent; a retraction half a second after that. Only a world that another takes the place of retracts what it cannot know.</para>
/// <para>The simulation's thread raises <see cref="Noticed"/>; one other thread, the game's, may read the same notices with
/// <see cref="TryRead"/>, without a lock.</para>
/// <para>Memory: the queue, and some 170 bytes for each contact that is neither confirmed nor retracted. These are no more than the world's
/// own segments, which the world bounds.</para>
/// </remarks>
/// <example>
/// A score that counts only confirmed contacts:
/// <code>
/// ContactNotices contacts = new(minClosingSpeed: 0.2); // m/s
/// using PeerThread host = PeerThread.Host(scene, options: new HostOptions { Contacts = contacts, Unprotected = true });
/// int score = 0;
///
/// // each frame
/// while (contacts.TryRead(out ContactNotice contact))
/// {
///     score += contact.Kind == NoticeKind.Confirmed ? 1 : 0;
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

    private readonly NoticeLedger<ContactNotice> ledger;

    /// <summary>Creates the notices for the contacts of one world, which is given them.</summary>
    /// <param name="minClosingSpeed">Slower contacts are not reported, in m/s; at least zero, default <see cref="DefaultMinClosingSpeed"/>.
    /// With zero a body that lies on another is reported a thousand times a second. Peers that are to get the same notices need the same
    /// value.</param>
    /// <param name="capacity">How many notices may wait to be read, 16 to <see cref="MaxCapacity"/>, default
    /// <see cref="DefaultCapacity"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    public ContactNotices(double minClosingSpeed = DefaultMinClosingSpeed, int capacity = DefaultCapacity)
        : this(minClosingSpeed, capacity, new NoticePairing<ContactNotice>())
    {
    }

    internal ContactNotices(double minClosingSpeed, int capacity, NoticePairing<ContactNotice> pairing)
    {
        if (!(minClosingSpeed >= 0) || double.IsInfinity(minClosingSpeed))
        {
            throw new ArgumentOutOfRangeException(nameof(minClosingSpeed), minClosingSpeed, "The least closing speed is a finite number of m/s, at"
                + " least zero.");
        }

        MinClosingSpeed = minClosingSpeed;
        ledger = new NoticeLedger<ContactNotice>(capacity, pairing);
    }

    /// <summary>
    /// Raised on the simulation's thread for every notice, none left out. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<ContactNotice>? Noticed
    {
        add => ledger.Noticed += value;
        remove => ledger.Noticed -= value;
    }

    /// <summary>Slower contacts are not reported, in m/s.</summary>
    public double MinClosingSpeed { get; }

    /// <summary>How many notices may wait to be read.</summary>
    public int Capacity => ledger.Capacity;

    /// <summary>
    /// The number of notices that <see cref="TryRead"/> will never return, because too many waited. Uncertain ones take at most
    /// half of the queue; other notices that find no room are left out too, each with a gap in <see cref="ContactNotice.Number"/>.
    /// <see cref="Noticed"/> had them. From any thread.
    /// </summary>
    public long Lost => ledger.Lost;

    /// <summary>How many contacts are predicted and neither confirmed nor retracted. On the simulation's thread.</summary>
    public int Pending => ledger.Pending;

    /// <summary>The next notice, in order; for one thread only, the game's. Takes no lock and allocates nothing.</summary>
    /// <returns>False if there is none at the moment.</returns>
    public bool TryRead(out ContactNotice notice) => ledger.TryRead(out notice);

    void IImpactObserver.OnContact(in EventKey impact, in ImpactContact contact)
    {
        if (contact.ClosingSpeed >= MinClosingSpeed)
        {
            ledger.Made(new ContactNotice(impact, contact));
        }
    }

    void IImpactObserver.OnCut(in EventKey impact) => ledger.Cut(impact);

    /// <inheritdoc cref="NoticeLedger{T}.Follow"/>
    internal void Follow() => ledger.Follow("contact");

    /// <inheritdoc cref="NoticeLedger{T}.Restart"/>
    internal void Restart() => ledger.Restart();

    /// <inheritdoc cref="NoticeLedger{T}.Begin"/>
    internal void Begin(SimTime from) => ledger.Begin(from);

    /// <inheritdoc cref="NoticeLedger{T}.Tell"/>
    internal void Tell(Simulation simulation) => ledger.Tell(simulation);

    /// <inheritdoc cref="NoticeLedger{T}.NextDue"/>
    internal SimTime NextDue(SimDuration history, SimDuration lookAhead) => ledger.NextDue(history, lookAhead);
}
