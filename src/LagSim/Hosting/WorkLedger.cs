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
/// <para>The unit is about a microsecond on one core of a machine of the 2020s. It is counted: events, the bodies that take part in each,
/// the paths that were tested for contact and what contact solvers did for it. The count is the same in every run, however busy the machine
/// is; a clock charges nobody, since it goes on while another program has the core. If the ledger has one it only tells how long the work
/// took. The world does not know the cost: it enters no state and no hash.</para>
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

    /// <summary>The cost of cutting a segment for a late event, besides what is simulated again. Measured by <c>LagSim.Bench -- counted</c>.</summary>
    private const double WorkPerCut = 1;

    private static readonly SimDuration TouchedFor = SimDuration.FromSeconds(30);
    private static readonly SimDuration StruckFor = SimDuration.FromSeconds(2);

    private readonly IClock? clock;

    private readonly Account[] accounts = new Account[Accounts + 1];
    private readonly List<byte> sharing = new();
    private Entry[] entries = new Entry[16]; // by place
    private readonly List<byte> healedFor = new(); // whose is being made good
    private double thisStep;
    private SimTime measured; // up to then all time is accounted for

    /// <summary>An empty ledger, for one world.</summary>
    /// <param name="clock">The clock that tells how long work takes (<see cref="SecondsFor"/>); null for none. No charge depends on it.</param>
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
    /// The largest cost of a step before it continues in the next, in units of about a microsecond, counted or by the clock, whichever is
    /// more; above zero, default 20,000.
    /// </summary>
    public double MaxWorkPerStep { get; set; } = DefaultMaxWorkPerStep;

    /// <summary>The amount charged to a player's account so far, in units of about a microsecond.</summary>
    public double ChargedTo(byte player) => accounts[player].Charged;

    /// <summary>
    /// How long the work for which a player was charged took by the clock, in seconds, in the same shares; 0 without a clock. It includes
    /// the time in which other programs had the core.
    /// </summary>
    public double SecondsFor(byte player) => accounts[player].Seconds;

    /// <summary>The part of <see cref="ChargedTo"/> for events simulated the first time, not re-simulated: the player's own doing.</summary>
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
    /// A late event was applied: what was cut for it, besides the events of its instant, is charged to the player whose it was.
    /// </summary>
    /// <param name="at">How far the world is simulated now.</param>
    /// <param name="segmentsCut">How many segments were cut.</param>
    internal void ChargeLateEvent(SimTime at, long segmentsCut) => ChargeLateEvent(Measured(WorkPerCut * segmentsCut), at);

    private bool ChargeLateEvent(in Cost cost, SimTime at)
    {
        bool goesOn = true;
        foreach (byte player in healedFor)
        {
            goesOn &= Charge(player, cost / healedFor.Count, at, isAgain: true);
        }

        return goesOn;
    }

    /// <summary>What was counted now, and how long it took since the last.</summary>
    private Cost Measured(double work)
    {
        Total += work;
        if (clock is null)
        {
            thisStep += work;
            return new Cost(work, 0);
        }

        SimTime now = clock.Now;
        double took = Math.Max(0, (now - measured).ToSeconds());
        measured = now;
        thisStep += Math.Max(work, took * 1e6); // so that a session serves its port in time; players pay for counted work alone
        return new Cost(ChargeRule?.Invoke(work, took * 1e6) ?? work, took);
    }

    /// <summary>
    /// What is charged of what was counted and of the microseconds that it took by the clock; null, the default, for the count alone. Only tests
    /// set it, to see that a clock that charges is noticed.
    /// </summary>
    internal Func<double, double, double>? ChargeRule { get; set; }

    /// <inheritdoc/>
    WorkVerdict IWorkObserver.OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table)
    {
        Cost cost = Measured(amount);
        bool isOfPlayer = key.Peer != Nobody && EventKinds.IsOfPlayers(key.Kind); // what rules touch stays on the account where it is
        for (int n = 0; n < bodies.Length && isOfPlayer; n++)
        {
            ref Entry entry = ref EntryOf(bodies[n], key.Time, table);
            entry.Charged = 0;
            entry.Give(key.Peer, key.Time + TouchedFor, key.Time + StruckFor);
        }

        byte owner = OwnerOf(bodies, key.Time, table, Nobody, out bool isShared);
        bool goesOn = Charge(bodies, owner, isShared, cost, key.Time, isAgain, out double mine);
        if (owner != Nobody)
        {
            Note(bodies, owner, key.Time, mine / bodies.Length);
        }

        return thisStep >= MaxWorkPerStep ? WorkVerdict.StopNow : goesOn ? WorkVerdict.GoOn : WorkVerdict.StopAfterInstant;
    }

    /// <inheritdoc/>
    /// <remarks>
    /// What rules compute in a call is the game's own, and nobody's, but for what they say of it. That and the call are charged like the event for
    /// which it is made: to the player of a command, the player of whom the host says something, or whose bodies took part.
    /// </remarks>
    WorkVerdict IWorkObserver.OnCall(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table)
    {
        Cost cost = Measured(amount);
        byte owner = OwnerOf(bodies, key.Time, table, CallerOf(key), out bool isShared);
        bool goesOn = Charge(bodies, owner, isShared, cost, key.Time, isAgain, out _);
        return thisStep >= MaxWorkPerStep ? WorkVerdict.StopNow : goesOn ? WorkVerdict.GoOn : WorkVerdict.StopAfterInstant;
    }

    /// <summary>The player who caused a call that is for no body.</summary>
    private static byte CallerOf(in EventKey key) => key.Kind switch
    {
        EventKind.Command => key.Peer,
        EventKind.Player => (byte)key.Body.Index,
        _ => Nobody,
    };

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
    private bool Charge(Span<int> bodies, byte owner, bool isShared, in Cost cost, SimTime at, bool isAgain, out double mine)
    {
        bool goesOn = true;
        Cost own = cost;
        if (isAgain && healedFor.Count > 0)
        {
            own = owner == Nobody ? default : cost / 2;
            goesOn &= ChargeLateEvent(owner == Nobody ? cost : own, at);
        }

        mine = own.Work;
        if (!isShared)
        {
            return Charge(owner, own, at, isAgain) && goesOn;
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
            goesOn &= Charge(one, own / sharing.Count, at, isAgain);
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

    private bool Charge(byte player, in Cost cost, SimTime at, bool isAgain)
    {
        ref Account account = ref accounts[player];
        account.Charged += cost.Work;
        account.First += isAgain ? 0 : cost.Work;
        account.Seconds += cost.Seconds;
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

    /// <summary>Work as it is counted, and how long it took.</summary>
    private readonly struct Cost
    {
        internal readonly double Work;
        internal readonly double Seconds;

        internal Cost(double work, double seconds)
        {
            Work = work;
            Seconds = seconds;
        }

        public static Cost operator /(in Cost cost, int shares) => new(cost.Work / shares, cost.Seconds / shares);
    }

    private struct Account
    {
        internal double Charged;
        internal double Seconds;
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
