using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// Accounts for the work of each player's actions: which players have little of their budget left, and which have used it up.
/// </summary>
/// <param name="world">The world, which counts the work.</param>
/// <param name="sharedTime">The session's time.</param>
/// <param name="budget">The budget of one player; null for no limit.</param>
internal sealed class WorkBudget(SharedWorld world, SharedClock sharedTime, PlayerBudget? budget)
{
    /// <summary>The account of bodies whose players are gone, and whose numbers were reassigned.</summary>
    internal const byte Departed = WorkLedger.Nobody - 1;

    /// <summary>The share of the budget below which a player may do no more for the moment.</summary>
    private const double LittleLeft = 0.5;

    /// <summary>The share of the budget at which a player is at rest: earlier work no longer counts towards the current episode.</summary>
    private const double NearlyAll = 0.9;

    /// <summary>
    /// The share of the budget that a body of another must have cost to be stopped when the player that moved it is expelled.
    /// </summary>
    private const double WorthStopping = 0.001;

    /// <summary>The share of the budget above which first-time work for a player's bodies is large.</summary>
    private const double Much = 0.1;

    /// <summary>The share of the largest charge from which another counts as equal.</summary>
    private const double Alike = 0.5;

    /// <summary>How far behind real time a world is late: well before a person is told of it, at a quarter of a second.</summary>
    private static readonly SimDuration Late = SimDuration.FromMilliseconds(100);

    private readonly Purse[] purses = new Purse[WorkLedger.Nobody];
    private SimTime counted = SimTime.MaxValue; // local clock

    /// <summary>
    /// Whether the world is so late that what stands in its way has to be undone: bodies are removed as of before the work with them. A world
    /// that keeps up is rewritten no further than where it stands.
    /// </summary>
    internal bool IsWorldLate => sharedTime.Now - Late > world.Live!.RenderedTo;

    /// <summary>Whether there is a budget, and a world that counts work.</summary>
    internal bool IsInForce => budget is not null && Ledger is not null;

    /// <summary>The work charged so far, by ascending number, for the numbers that were charged anything.</summary>
    internal IReadOnlyList<PlayerCost> Costs
    {
        get
        {
            List<PlayerCost> costs = [];
            for (byte player = 0; player <= SessionOptions.MaxClients && Ledger is WorkLedger ledger; player++)
            {
                if (ledger.ChargedTo(player) > 0)
                {
                    costs.Add(new PlayerCost(player, ledger.ChargedTo(player), ledger.SecondsFor(player), purses[player].Most));
                }
            }

            return costs;
        }
    }

    private WorkLedger? Ledger => world.Live?.Work;

    private double Whole => budget!.WorkAtOnce;

    /// <summary>Whether a player has so little of its budget left that its events are refused, except those that reduce work.</summary>
    internal bool IsShort(in ExternalEvent external) =>
        budget is not null && counted != SimTime.MaxValue && purses[external.Peer].Left < Whole * LittleLeft
        && external.Kind is not (EventKind.Remove or EventKind.Release);

    /// <summary>Opens an account for a number that got a new holder; bodies of the former holder are not charged to it.</summary>
    internal void BeginAccount(byte player)
    {
        if (IsInForce)
        {
            Ledger!.Transfer(player, Departed);
            purses[player] = new Purse { Left = Whole, Charged = Ledger.ChargedTo(player) };
            Calm(player);
        }
    }

    /// <summary>Charges the work since the last call, while the budget is in force, and credits the elapsed time.</summary>
    internal void Count(SimTime now)
    {
        WorkLedger ledger = Ledger!;
        bool isFirst = counted == SimTime.MaxValue;
        double gain = isFirst ? Whole : (now - counted).ToSeconds() * budget!.WorkPerSecond;
        counted = now;
        for (int player = 0; player < purses.Length; player = player == SessionOptions.MaxClients ? Departed : player + 1)
        {
            ref Purse purse = ref purses[player];
            double charged = ledger.ChargedTo((byte)player);
            purse.Left = Math.Min(Whole, purse.Left + gain) - (charged - purse.Charged);
            purse.Charged = charged;
            purse.Most = Math.Max(purse.Most, Whole - purse.Left);
            if (purse.Left >= Whole * NearlyAll)
            {
                Calm((byte)player);
            }

            ledger.Limit((byte)player, player == 0 ? double.PositiveInfinity : charged + Math.Max(0, purse.Left));
        }
    }

    /// <summary>Returns the player most over its budget; <see cref="Departed"/> for departed players, 0 for none.</summary>
    internal byte Overdrawn()
    {
        byte worst = 0;
        for (byte player = 1; player <= SessionOptions.MaxClients; player++)
        {
            worst = purses[player].Left <= 0 && (worst == 0 || purses[player].Left < purses[worst].Left) ? player : worst;
        }

        return worst == 0 && purses[Departed].Left <= 0 ? Departed : worst;
    }

    /// <summary>Returns the player to expel when one has used up its budget.</summary>
    /// <remarks>
    /// Of the players with little left it is the one whose bodies caused the most first-time work, if that is large; otherwise the one over
    /// its budget. A player whose events make others' work be re-simulated pays for it too, but is not its cause. Among players charged
    /// about equally, because their bodies collide, it is the one whose bodies move fastest: the player that holds a ball is not the one
    /// that makes it bounce a million times a second.
    /// </remarks>
    internal byte Culprit(byte worst)
    {
        byte[] tight = worst == Departed ? []
            : [.. Enumerable.Range(1, SessionOptions.MaxClients).Select(n => (byte)n).Where(n => purses[n].Left < Whole * LittleLeft)];
        double most = tight.Select(Own).DefaultIfEmpty(0).Max();
        return most < Whole * Much ? worst : tight.Where(n => Own(n) > most * Alike).OrderByDescending(SpeedOf).First();

        double Own(byte player) => Ledger!.FirstChargedTo(player) - purses[player].CalmFirst;

        double SpeedOf(byte player)
        {
            Simulation simulation = world.Live!.Simulation;
            double speed = 0;
            foreach (BodyId body in Ledger!.CostlyBodiesOf(player, 0))
            {
                bool isThere = simulation.TryRead(body, simulation.SimulatedTo, out BodyState state);
                speed = isThere ? Math.Max(speed, state.Velocity.Length) : speed;
            }

            return speed;
        }
    }

    /// <summary>The work charged to a player since it last was at rest, the seconds that it took, and within how many that was.</summary>
    internal (double Work, double Took, double Within) SpentBy(byte player) => (
        purses[player].Charged - purses[player].CalmAt, Ledger!.SecondsFor(player) - purses[player].CalmSeconds,
        Math.Max(0.001, (sharedTime.Now - purses[player].Calm).ToSeconds()));

    /// <summary>Since when a player has been charged without a rest, in simulated time.</summary>
    internal SimTime ChargedSince(byte player) => Ledger!.ChargedSince(player);

    /// <summary>The bodies for which a player was charged much.</summary>
    internal IReadOnlyList<BodyId> CostlyBodiesOf(byte player) => Ledger!.CostlyBodiesOf(player, Whole * WorthStopping);

    /// <summary>Refills every account: what others were charged meanwhile was, or may have been, caused by the expelled player.</summary>
    internal void Restart(SimTime now)
    {
        for (int n = 0; n < purses.Length; n++)
        {
            purses[n].Left = Whole;
            Calm((byte)n);
        }

        Count(now);
    }

    private void Calm(byte player)
    {
        WorkLedger ledger = Ledger!;
        ledger.Calm(player);
        ref Purse purse = ref purses[player];
        purse.Calm = sharedTime.Now;
        purse.CalmAt = purse.Charged;
        purse.CalmFirst = ledger.FirstChargedTo(player);
        purse.CalmSeconds = ledger.SecondsFor(player);
    }

    private struct Purse
    {
        internal double Left;
        internal double Charged; // at the last count
        internal double Most; // the most ever spent at once
        internal double CalmAt; // charged when it last was nearly full
        internal double CalmFirst; // the first-time part of that
        internal double CalmSeconds; // how long that took
        internal SimTime Calm; // shared time of that
    }
}
