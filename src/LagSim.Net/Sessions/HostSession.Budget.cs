using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <content>What one player may cost: who takes more than its share of the work has its acts refused, then is sent away, and its bodies are removed.</content>
public sealed partial class HostSession
{
    /// <summary>The account of bodies whose players are gone, and their numbers others'.</summary>
    private const byte Departed = WorkLedger.Nobody - 1;

    /// <summary>Who has less than this part of its budget left may do no more for the moment; and while the world is late, who has is sent away.</summary>
    private const double LittleLeft = 0.5;

    /// <summary>A player that has this part of its budget is at rest: what cost before is no part of what costs now.</summary>
    private const double NearlyAll = 0.9;

    /// <summary>What a body that is not its own must have cost, as a part of the budget, for it to be stopped with the player that moved it.</summary>
    private const double WorthStopping = 0.001;

    /// <summary>What is much to have been done for a player's bodies the first time, as a part of the budget.</summary>
    private const double Much = 0.1;

    /// <summary>Who has at least this part of what another has is charged alike.</summary>
    private const double Alike = 0.5;

    private const int MostStops = 1024;

    /// <summary>A world so far behind real time is late.</summary>
    private static readonly SimDuration Late = SimDuration.FromMilliseconds(150);

    /// <summary>For so long nobody is let in from a machine after a player from there was sent away for its cost; twice as long each further time, up to an hour.</summary>
    private static readonly SimDuration ShutOutFor = SimDuration.FromSeconds(60);

    private static readonly SimDuration LongestShutOut = SimDuration.FromSeconds(3600);

    private readonly Purse[] purses = new Purse[WorkLedger.Nobody];
    private readonly List<ExternalEvent> acts = new(); // accepted, on bodies that are not the player's own, and not before the watermark
    private readonly Dictionary<PeerAddress, (SimTime Until, SimDuration For)> shutOut = new(); // by machine
    private SimTime counted = SimTime.MaxValue; // own clock

    /// <summary>
    /// Raised on the session's thread when a player is sent away because its acts cost more than <see cref="SessionOptions.PlayerBudget"/>, with why, and what was
    /// removed. <see cref="JoinerGone"/> is raised too. Handlers must not throw.
    /// </summary>
    public event Action<PlayerExpulsion>? PlayerExpelled;

    /// <summary>What the players' acts cost so far, by ascending number, of those for whom anything was charged. On the session's thread.</summary>
    public IReadOnlyList<PlayerCost> Costs
    {
        get
        {
            List<PlayerCost> costs = [];
            for (byte player = 0; player <= SessionOptions.MaxJoiners && World?.Work is WorkLedger ledger; player++)
            {
                if (ledger.ChargedTo(player) > 0)
                {
                    costs.Add(new PlayerCost(player, ledger.ChargedTo(player), purses[player].Most));
                }
            }

            return costs;
        }
    }

    private protected override bool TendWorld(SimTime now)
    {
        if (Options.PlayerBudget is not PlayerBudget budget || World?.Work is not WorkLedger ledger)
        {
            return false;
        }

        Count(budget, ledger, now);
        SimTime settles = Watermark;
        if (acts.Count > 0 && (acts[0].Time < settles || acts.Count > 10 * Options.MaxEventsPerSecond))
        {
            acts.RemoveAll(act => act.Time < settles);
        }

        double least = SharedTime.Now - Late > World.PictureTo ? budget.WorkAtOnce * LittleLeft : 0;
        byte worst = 0;
        for (byte player = 1; player <= SessionOptions.MaxJoiners; player++)
        {
            worst = purses[player].Left <= least && (worst == 0 || purses[player].Left < purses[worst].Left) ? player : worst;
        }

        worst = worst == 0 && purses[Departed].Left <= least ? Departed : worst;
        if (worst == 0 || State != SessionState.Running)
        {
            return false;
        }

        Expel(Culprit(worst, budget, ledger), budget, ledger, now);
        return true;
    }

    /// <summary>Whether a player has so little of its budget left that what it does is refused, but for what makes less work.</summary>
    private bool IsShortOfBudget(in ExternalEvent external) =>
        Options.PlayerBudget is PlayerBudget budget && counted != SimTime.MaxValue && purses[external.Peer].Left < budget.WorkAtOnce * LittleLeft
        && external.Kind is not (EventKind.Remove or EventKind.Release);

    /// <summary>Remembers an accepted act on a body that is not the player's own, so that the body can be stopped should the player be sent away.</summary>
    private void NoteAct(in ExternalEvent external)
    {
        if (Options.PlayerBudget is not null && external.Body.Peer != external.Peer)
        {
            acts.Add(external);
        }
    }

    /// <summary>A number is given to somebody who did not have it before: what its former holder left there is not his.</summary>
    private void BeginAccount(byte player)
    {
        if (World?.Work is WorkLedger ledger && Options.PlayerBudget is PlayerBudget budget)
        {
            ledger.Transfer(player, Departed);
            ledger.Calm(player);
            purses[player] = new Purse { Left = budget.WorkAtOnce, Charged = ledger.ChargedTo(player), CalmAt = ledger.ChargedTo(player), CalmFirst = ledger.FirstChargedTo(player), Calm = SharedTime.Now };
        }
    }

    private bool IsShutOut(PeerAddress machine, SimTime now) => shutOut.TryGetValue(machine, out (SimTime Until, SimDuration For) until) && now < until.Until;

    /// <summary>Shuts a machine out no longer; false if it was not.</summary>
    private bool LetInAgain(PeerAddress machine, SimTime now)
    {
        bool wasShutOut = IsShutOut(machine, now);
        shutOut.Remove(machine);
        return wasShutOut;
    }

    private void Count(PlayerBudget budget, WorkLedger ledger, SimTime now)
    {
        bool isFirst = counted == SimTime.MaxValue;
        double gain = isFirst ? budget.WorkAtOnce : (now - counted).ToSeconds() * budget.WorkPerSecond;
        counted = now;
        for (int player = 0; player < purses.Length; player = player == SessionOptions.MaxJoiners ? Departed : player + 1)
        {
            ref Purse purse = ref purses[player];
            double charged = ledger.ChargedTo((byte)player);
            purse.Left = Math.Min(budget.WorkAtOnce, purse.Left + gain) - (charged - purse.Charged);
            purse.Charged = charged;
            purse.Most = Math.Max(purse.Most, budget.WorkAtOnce - purse.Left);
            if (purse.Left >= budget.WorkAtOnce * NearlyAll)
            {
                ledger.Calm((byte)player);
                purse.Calm = SharedTime.Now;
                purse.CalmAt = charged;
                purse.CalmFirst = ledger.FirstChargedTo((byte)player);
            }

            ledger.Limit((byte)player, player == 0 ? double.PositiveInfinity : charged + Math.Max(0, purse.Left));
        }
    }

    /// <summary>
    /// Who is to go if one has used up its budget: of those that have little left the one for whose bodies most was done the first time, if that is much; else that one. Whose news has what
    /// another does simulated again and again pays for it too, but it is not its doing. And of those who are charged alike, for their bodies meet, the one whose bodies move the fastest: it
    /// is not who holds a ball that makes it bounce a million times a second.
    /// </summary>
    private byte Culprit(byte worst, PlayerBudget budget, WorkLedger ledger)
    {
        byte[] tight = worst == Departed ? [] : [.. Enumerable.Range(1, SessionOptions.MaxJoiners).Select(n => (byte)n).Where(n => purses[n].Left < budget.WorkAtOnce * LittleLeft)];
        double most = tight.Select(Own).DefaultIfEmpty(0).Max();
        return most < budget.WorkAtOnce * Much ? worst : tight.Where(n => Own(n) > most * Alike).OrderByDescending(SpeedOf).First();

        double Own(byte player) => ledger.FirstChargedTo(player) - purses[player].CalmFirst;

        double SpeedOf(byte player)
        {
            Simulation world = World!.Simulation;
            double speed = 0;
            foreach (BodyId body in ledger.CostlyBodiesOf(player, 0))
            {
                speed = world.TryRead(body, world.SimulatedTo, out BodyState state) ? Math.Max(speed, state.Velocity.Length) : speed;
            }

            return speed;
        }
    }

    private void Expel(byte player, PlayerBudget budget, WorkLedger ledger, SimTime now)
    {
        Simulation world = World!.Simulation;
        SimTime from = SimTime.Max(SimTime.Max(Watermark, world.HistoryEdge), SimTime.Min(ledger.ChargedSince(player), world.SimulatedTo));
        double work = purses[player].Charged - purses[player].CalmAt;
        double seconds = Math.Max(0.001, (SharedTime.Now - purses[player].Calm).ToSeconds());
        if (joiners.Find(j => j.Peer == player) is Joiner joiner)
        {
            PeerAddress machine = joiner.Link.Other.Machine;
            SimDuration span = shutOut.TryGetValue(machine, out (SimTime Until, SimDuration For) last) ? Twice(last.For) : ShutOutFor;
            shutOut[machine] = (now + span, span);
        }

        bool wasThere = SendAway(j => j.Peer == player) > 0;
        IReadOnlyList<BodyId> costly = ledger.CostlyBodiesOf(player, budget.WorkAtOnce * WorthStopping);
        int removed = RemoveSpawned(player == Departed ? costly.Where(body => body.Sequence > 0) : null, player, from);
        ILookup<BodyId, SimTime> touched = acts.Where(act => act.Peer == player && act.Time >= from).ToLookup(act => act.Body, act => act.Time);
        int stopped = 0;
        int stops = 0;
        foreach (BodyId body in costly.Concat(touched.Select(act => act.Key)).Distinct().Where(MayBeStopped))
        {
            // Before what he did to it, and right after each thing that he did.
            SimTime[] times = [from, .. touched[body].Distinct().OrderBy(time => time).Select(time => time + SimDuration.OneTick)];
            for (int n = 0; n < times.Length && stops < MostStops; n++, stops++)
            {
                DoAt(PlayerAction.SetVelocity(body, Vector3D.Zero), times[n]);
            }

            stopped++;
        }

        // What others were charged meanwhile was for what it did to them, or may have been.
        for (int n = 0; n < purses.Length; n++)
        {
            ledger.Calm((byte)n);
            purses[n].Left = budget.WorkAtOnce;
            purses[n].CalmAt = purses[n].Charged;
            purses[n].CalmFirst = ledger.FirstChargedTo((byte)n);
            purses[n].Calm = SharedTime.Now;
        }

        Count(budget, ledger, now);
        PlayerExpelled?.Invoke(new PlayerExpulsion(player == Departed ? (byte)0 : player, wasThere, work, seconds, removed, stopped, from));

        bool MayBeStopped(BodyId body) => body.Peer != player && (player != Departed || body.Sequence == 0);
    }

    /// <summary>Removes bodies that a player spawned, all if none are named, as of an instant, and those that are spawned later as they are.</summary>
    private int RemoveSpawned(IEnumerable<BodyId>? some, byte player, SimTime from)
    {
        HashSet<BodyId>? named = some is null ? null : [.. some];
        int removed = 0;
        foreach ((BodyId body, SimTime since) in Limits.Spawned(player, named))
        {
            DoAt(PlayerAction.Remove(body), SimTime.Max(from, since));
            removed++;
        }

        return removed;
    }

    private static SimDuration Twice(SimDuration span) => span > LongestShutOut / 2 ? LongestShutOut : span * 2;

    private struct Purse
    {
        internal double Left;
        internal double Charged; // when it was counted last
        internal double Most; // spent at a time
        internal double CalmAt; // charged when it last was nearly whole
        internal double CalmFirst; // of that what was done the first time
        internal SimTime Calm; // shared time then
    }
}
