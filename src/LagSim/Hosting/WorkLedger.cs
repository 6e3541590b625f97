using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>Accounts for the cost of simulating a world, by the player whose actions caused it.</summary>
/// <remarks>
/// <para>Each body is on the account of the player that spawned it or whose action touched it last. A body of the scene that no player
/// touched is on no account. A body of the scene that is touched is on that account for 30 s of simulated time. One that is struck by a
/// body on an account is on it for 2 s, and no longer than 2 s after the action behind it: what the scene would do by itself is not charged
/// to players. An event is charged to the accounts of the bodies that take part, to each in equal shares, however many of its bodies take
/// part. Half of the re-simulation for a late event is charged to the player of that event.</para>
/// <para>The unit is about a microsecond on one core of a machine of the 2020s. It is counted by events, by how many bodies take part in
/// each and what contact solvers did for it. If the ledger has a clock, and by it something took longer than was counted, that time is the
/// cost: no count foresees everything that can be expensive. A clock that stands still, as in virtual time, leaves the count, which is the
/// same in every run. The world does not know the cost: it enters no state and no hash.</para>
/// <para>For the simulation's thread. Cost: some ten nanoseconds an event, and a reading of the clock; for each body that was there at a
/// time some 24 bytes.</para>
/// </remarks>
public sealed class WorkLedger : IWorkObserver
{
    /// <summary>How many accounts there are: one for each number that a player can have in an event.</summary>
    public const int Accounts = byte.MaxValue;

    /// <summary>The account of no player: the scene's own, before any action.</summary>
    public const byte Nobody = byte.MaxValue;

    private const double DefaultMaxWorkPerStep = 20_000;

    /// <summary>One event never takes longer: this thread was not at work meanwhile.</summary>
    private static readonly SimDuration MaxTimePerEvent = SimDuration.FromMilliseconds(20);

    private static readonly SimDuration TouchedFor = SimDuration.FromSeconds(30);
    private static readonly SimDuration StruckFor = SimDuration.FromSeconds(2);

    private readonly IClock? clock;

    private readonly Account[] accounts = new Account[Accounts + 1];
    private readonly List<byte> sharing = new();
    private Entry[] entries = new Entry[16]; // by place
    private readonly List<byte> healedFor = new(); // whose is being made good
    private double thisStep;
    private SimTime measured; // up to then all is accounted for

    /// <summary>An empty ledger, for one world.</summary>
    /// <param name="clock">The clock that measures how long work takes; null to only count it.</param>
    public WorkLedger(IClock? clock = null)
    {
        this.clock = clock;
        for (int n = 0; n < accounts.Length; n++)
        {
            accounts[n].Most = double.PositiveInfinity;
            accounts[n].Since = SimTime.MaxValue;
        }
    }

    /// <summary>All that was done so far, in units of about a microsecond.</summary>
    public double Total { get; private set; }

    /// <summary>
    /// The largest cost of a step before it continues in the next, in units of about a microsecond; above zero, default 20,000.
    /// </summary>
    public double MaxWorkPerStep { get; set; } = DefaultMaxWorkPerStep;

    /// <summary>The amount charged to a player's account so far, in units of about a microsecond.</summary>
    public double ChargedTo(byte player) => accounts[player].Charged;

    /// <summary>The part of that for events simulated the first time, not re-simulated: the player's own doing.</summary>
    public double FirstChargedTo(byte player) => accounts[player].First;

    /// <summary>
    /// The earliest simulated instant of the charges to a player since <see cref="Calm"/>; the latest there is if there were none.
    /// </summary>
    public SimTime ChargedSince(byte player) => accounts[player].Since;

    /// <summary>
    /// Sets up to which <see cref="ChargedTo"/> a player may be charged before each advance stops; <see cref="double.PositiveInfinity"/>
    /// for no limit.
    /// </summary>
    public void Limit(byte player, double most) => accounts[player].Most = most;

    /// <summary>
    /// Forgives all charges so far: <see cref="ChargedSince"/> and <see cref="CostlyBodiesOf"/> count from here on.
    /// </summary>
    public void Calm(byte player)
    {
        ref Account account = ref accounts[player];
        account.Since = SimTime.MaxValue;
        account.Period++;
    }

    /// <summary>
    /// Notes whose late event is being applied: what it has simulated again is charged to that player by one half, shared with those whose
    /// late events are being healed already.
    /// </summary>
    internal void NoteLateEvent(byte player, bool isHealing)
    {
        if (!isHealing)
        {
            healedFor.Clear();
        }

        if (!healedFor.Contains(player))
        {
            healedFor.Add(player);
        }
    }

    /// <summary>All bodies that are on one player's account go to another's.</summary>
    public void Transfer(byte from, byte to)
    {
        for (int slot = 0; slot < entries.Length; slot++)
        {
            if (entries[slot].HasOwner && entries[slot].Owner == from)
            {
                entries[slot].Owner = to;
                entries[slot].Period = 0;
                entries[slot].Charged = 0;
            }
        }
    }

    /// <summary>
    /// The bodies on a player's account with more than so much charged for them since <see cref="Calm"/>, the costliest first.
    /// </summary>
    public IReadOnlyList<BodyId> CostlyBodiesOf(byte player, double atLeast)
    {
        List<(double Charged, BodyId Body)> found = [];
        for (int slot = 0; slot < entries.Length; slot++)
        {
            ref readonly Entry entry = ref entries[slot];
            if (entry.HasOwner && entry.Owner == player && entry.Period == accounts[player].Period && entry.Charged >= atLeast)
            {
                found.Add((entry.Charged, entry.Body));
            }
        }

        found.Sort((a, b) => a.Charged != b.Charged ? b.Charged.CompareTo(a.Charged) : a.Body.CompareTo(b.Body));
        return found.ConvertAll(f => f.Body);
    }

    /// <summary>A step of the world begins.</summary>
    internal void BeginStep() => thisStep = 0;

    /// <summary>The world is at work from now on.</summary>
    internal void Resume() => measured = clock?.Now ?? default;

    /// <summary>
    /// A late event was applied: what that took, besides the events of its instant, is charged to the player whose it was.
    /// </summary>
    internal void ChargeLateEvent(SimTime at)
    {
        double took = Measure();
        Total += took;
        thisStep += took;
        if (took > 0)
        {
            ChargeLateEvent(took, at);
        }
    }

    private bool ChargeLateEvent(double amount, SimTime at)
    {
        bool goesOn = true;
        foreach (byte player in healedFor)
        {
            goesOn &= Charge(player, amount / healedFor.Count, at, isAgain: true);
        }

        return goesOn;
    }

    private double Measure()
    {
        if (clock is null)
        {
            return 0;
        }

        SimTime now = clock.Now;
        SimDuration took = now - measured;
        measured = now;
        return Math.Max(0, (took > MaxTimePerEvent ? MaxTimePerEvent : took).ToSeconds() * 1e6);
    }

    /// <inheritdoc/>
    WorkVerdict IWorkObserver.OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table)
    {
        amount = Math.Max(amount, Measure());
        Total += amount;
        thisStep += amount;
        for (int n = 0; n < bodies.Length && EventKinds.IsOfPlayers(key.Kind); n++)
        {
            ref Entry entry = ref EntryOf(bodies[n], key.Time, table);
            entry.Charged = 0;
            entry.Give(key.Peer, key.Time + TouchedFor, key.Time + StruckFor);
        }

        byte owner = OwnerOf(bodies, key.Time, table, Nobody, out bool isShared);
        bool goesOn = Charge(bodies, owner, isShared, amount, key.Time, isAgain, out double mine);
        if (owner != Nobody)
        {
            Note(bodies, owner, key.Time, mine / bodies.Length);
        }

        return thisStep >= MaxWorkPerStep ? WorkVerdict.StopNow : goesOn ? WorkVerdict.GoOn : WorkVerdict.StopAfterInstant;
    }

    /// <inheritdoc/>
    /// <remarks>
    /// What rules compute in a call is the game's own, and nobody's. That there is a call is charged like the event for which it is made: to
    /// the player of a command, or whose bodies took part.
    /// </remarks>
    WorkVerdict IWorkObserver.OnCall(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table)
    {
        double took = Math.Max(amount, Measure());
        Total += took;
        thisStep += took;
        byte owner = OwnerOf(bodies, key.Time, table, key.Kind == EventKind.Command ? key.Peer : Nobody, out bool isShared);
        bool goesOn = Charge(bodies, owner, isShared, amount, key.Time, isAgain, out _);
        return thisStep >= MaxWorkPerStep ? WorkVerdict.StopNow : goesOn ? WorkVerdict.GoOn : WorkVerdict.StopAfterInstant;
    }

    /// <summary>Whose account bodies are on: of several that of the last, and if they are on none the one that is given.</summary>
    /// <param name="bodies">The places of the bodies.</param>
    /// <param name="at">When.</param>
    /// <param name="table">Names the bodies.</param>
    /// <param name="otherwise">The account if they are on none.</param>
    /// <param name="isShared">Whether they are on several.</param>
    private byte OwnerOf(Span<int> bodies, SimTime at, BodyTable table, byte otherwise, out bool isShared)
    {
        isShared = false;
        byte owner = otherwise;
        foreach (int slot in bodies)
        {
            byte its = EntryOf(slot, at, table).Owner;
            isShared |= its != Nobody && owner != Nobody && its != owner;
            owner = its == Nobody ? owner : its;
        }

        return owner;
    }

    /// <summary>Charges what some bodies took part in, to their owners and to those whose late events are healed; whether all may go on.</summary>
    private bool Charge(Span<int> bodies, byte owner, bool isShared, double amount, SimTime at, bool isAgain, out double mine)
    {
        bool goesOn = true;
        mine = amount;
        if (isAgain && healedFor.Count > 0)
        {
            mine = owner == Nobody ? 0 : amount / 2;
            goesOn &= ChargeLateEvent(amount - mine, at);
        }

        if (!isShared)
        {
            return Charge(owner, mine, at, isAgain) && goesOn;
        }

        sharing.Clear();
        foreach (int slot in bodies)
        {
            byte one = entries[slot].Owner;
            if (one != Nobody && !sharing.Contains(one))
            {
                sharing.Add(one);
            }
        }

        foreach (byte one in sharing)
        {
            goesOn &= Charge(one, mine / sharing.Count, at, isAgain);
        }

        return goesOn;
    }

    private void Note(Span<int> bodies, byte struckBy, SimTime at, double each)
    {
        SimTime until = at;
        foreach (int slot in bodies)
        {
            until = entries[slot].Owner == struckBy ? SimTime.Max(until, SimTime.Min(entries[slot].Spreads, at + StruckFor)) : until;
        }

        foreach (int slot in bodies)
        {
            ref Entry entry = ref entries[slot];
            if (entry.Owner == Nobody && until > at)
            {
                entry.Give(struckBy, until, until);
            }

            int period = accounts[entry.Owner].Period;
            entry.Charged = entry.Period == period ? entry.Charged + each : each;
            entry.Period = period;
        }
    }

    private bool Charge(byte player, double amount, SimTime at, bool isAgain)
    {
        ref Account account = ref accounts[player];
        account.Charged += amount;
        account.First += isAgain ? 0 : amount;
        account.Since = at < account.Since ? at : account.Since;
        return account.Charged < account.Most;
    }

    private ref Entry EntryOf(int slot, SimTime at, BodyTable table)
    {
        if (slot >= entries.Length)
        {
            Array.Resize(ref entries, Math.Max(slot + 1, entries.Length * 2));
        }

        ref Entry entry = ref entries[slot];
        BodyId body = table.Id(slot);
        if (!entry.HasOwner || entry.Body != body)
        {
            entry = new Entry { Body = body, HasOwner = true };
            entry.Give(body.Sequence == 0 ? Nobody : body.Peer, SimTime.MaxValue, SimTime.MaxValue);
        }

        entry.Owner = at > entry.Until ? Nobody : entry.Owner;

        return ref entry;
    }

    private struct Account
    {
        internal double Charged;
        internal double First;
        internal double Most;
        internal SimTime Since;
        internal int Period;
    }

    /// <summary>The record of the body in a place.</summary>
    private struct Entry
    {
        internal BodyId Body;
        internal double Charged; // of its owner, in that period
        internal int Period;
        internal byte Owner;
        internal bool HasOwner;
        internal SimTime Until; // it is on that account
        internal SimTime Spreads; // to bodies of the scene that it strikes, until then

        /// <summary>Puts it on an account; a body that a player spawned stays there.</summary>
        internal void Give(byte owner, SimTime until, SimTime spreads)
        {
            bool isOfScene = Body.Sequence == 0;
            (Owner, Until, Spreads) = (owner, isOfScene ? until : SimTime.MaxValue, isOfScene ? spreads : SimTime.MaxValue);
        }
    }
}
