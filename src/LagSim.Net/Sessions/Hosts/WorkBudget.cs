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

/// <summary>What each player's acts have cost of its budget: who has little left, and who has used it up.</summary>
/// <param name="world">The world, which counts the work.</param>
/// <param name="sharedTime">The session's time.</param>
/// <param name="budget">What one player may cost; null for no limit.</param>
internal sealed class WorkBudget(SharedWorld world, SharedClock sharedTime, PlayerBudget? budget)
{
    /// <summary>The account of bodies whose players are gone, and their numbers others'.</summary>
    internal const byte Departed = WorkLedger.Nobody - 1;

    /// <summary>
    /// Who has less than this part of its budget left may do no more for the moment; and while the world is late, who has is sent away.
    /// </summary>
    private const double LittleLeft = 0.5;

    /// <summary>A player that has this part of its budget is at rest: what cost before is no part of what costs now.</summary>
    private const double NearlyAll = 0.9;

    /// <summary>
    /// What a body that is not its own must have cost, as a part of the budget, for it to be stopped with the player that moved it.
    /// </summary>
    private const double WorthStopping = 0.001;

    /// <summary>What is much to have been done for a player's bodies the first time, as a part of the budget.</summary>
    private const double Much = 0.1;

    /// <summary>Who has at least this part of what another has is charged alike.</summary>
    private const double Alike = 0.5;

    /// <summary>A world so far behind real time is late.</summary>
    private static readonly SimDuration Late = SimDuration.FromMilliseconds(150);

    private readonly Purse[] purses = new Purse[WorkLedger.Nobody];
    private SimTime counted = SimTime.MaxValue; // own clock

    /// <summary>Whether there is a budget, and a world that counts work.</summary>
    internal bool IsInForce => budget is not null && Ledger is not null;

    /// <summary>What was charged so far, by ascending number, of those for whom anything was.</summary>
    internal IReadOnlyList<PlayerCost> Costs
    {
        get
        {
            List<PlayerCost> costs = [];
            for (byte player = 0; player <= SessionOptions.MaxClients && Ledger is WorkLedger ledger; player++)
            {
                if (ledger.ChargedTo(player) > 0)
                {
                    costs.Add(new PlayerCost(player, ledger.ChargedTo(player), purses[player].Most));
                }
            }

            return costs;
        }
    }

    private WorkLedger? Ledger => world.Live?.Work;

    private double Whole => budget!.WorkAtOnce;

    /// <summary>Whether a player has so little of its budget left that what it does is refused, but for what makes less work.</summary>
    internal bool IsShort(in ExternalEvent external) =>
        budget is not null && counted != SimTime.MaxValue && purses[external.Peer].Left < Whole * LittleLeft
        && external.Kind is not (EventKind.Remove or EventKind.Release);

    /// <summary>A number is given to somebody who did not have it before: what its former holder left there is not his.</summary>
    internal void BeginAccount(byte player)
    {
        if (IsInForce)
        {
            Ledger!.Transfer(player, Departed);
            purses[player] = new Purse { Left = Whole, Charged = Ledger.ChargedTo(player) };
            Calm(player);
        }
    }

    /// <summary>Charges what was done since the last time, while the budget is in force, and credits what time gives.</summary>
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

    /// <summary>
    /// Who has used up its budget, the one most over it; <see cref="Departed"/> for those who are gone, and 0 for nobody. While the world
    /// is late, half of it is all there is.
    /// </summary>
    internal byte Overdrawn()
    {
        double least = sharedTime.Now - Late > world.Live!.RenderedTo ? Whole * LittleLeft : 0;
        byte worst = 0;
        for (byte player = 1; player <= SessionOptions.MaxClients; player++)
        {
            worst = purses[player].Left <= least && (worst == 0 || purses[player].Left < purses[worst].Left) ? player : worst;
        }

        return worst == 0 && purses[Departed].Left <= least ? Departed : worst;
    }

    /// <summary>
    /// Who is to go if one has used up its budget: of those that have little left the one for whose bodies most was done the first time, if
    /// that is much; else that one. Whose events have what
    /// another does simulated again and again pays for it too, but it is not its doing. And of those who are charged alike, for their
    /// bodies meet, the one whose bodies move the fastest: it
    /// is not who holds a ball that makes it bounce a million times a second.
    /// </summary>
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

    /// <summary>What was charged to a player since it last was at rest, and for how many seconds.</summary>
    internal (double Work, double Seconds) SpentBy(byte player) =>
        (purses[player].Charged - purses[player].CalmAt, Math.Max(0.001, (sharedTime.Now - purses[player].Calm).ToSeconds()));

    /// <summary>Since when a player has been charged without a rest, in simulated time.</summary>
    internal SimTime ChargedSince(byte player) => Ledger!.ChargedSince(player);

    /// <summary>The bodies for which much was charged to a player.</summary>
    internal IReadOnlyList<BodyId> CostlyBodiesOf(byte player) => Ledger!.CostlyBodiesOf(player, Whole * WorthStopping);

    /// <summary>
    /// Gives everybody all of it anew: what others were charged meanwhile was for what one who was sent away did to them, or may have been.
    /// </summary>
    internal void StartAnew(SimTime now)
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
    }

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
