using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Expels a player that has used up its budget, removes its bodies, and stops others that it moved.</summary>
internal sealed class BudgetEnforcer(
    WorkBudget budget, RecentTouches acts, ClientRoster roster, BanList shutOuts, BodyRemoval removal,
    HostActions actions, SharedWorld world, Watermark watermark, SessionStatus status)
{
    private const int MaxStops = 1024;

    /// <summary>Raised when a player is expelled, with the cost and what was removed.</summary>
    internal event Action<PlayerExpulsion>? Expelled;

    /// <inheritdoc cref="WorkBudget.Costs"/>
    internal IReadOnlyList<PlayerCost> Costs => budget.Costs;

    /// <summary>Charges the work of the world's last step; true if a player was expelled for it, which changed the world.</summary>
    internal bool Tend(SimTime now)
    {
        if (!budget.IsInForce)
        {
            return false;
        }

        budget.Count(now);
        acts.Forget(watermark.Now);
        byte worst = budget.Overdrawn();
        if (worst == 0 || status.State != SessionState.Running)
        {
            return false;
        }

        watermark.Hold();
        try
        {
            Expel(budget.Culprit(worst), now);
        }
        finally
        {
            watermark.Resume();
        }

        return true;
    }

    private void Expel(byte player, SimTime now)
    {
        Simulation simulation = world.Live!.Simulation;
        SimTime stands = simulation.SimulatedTo;
        SimTime from = SimTime.Max(
            SimTime.Max(watermark.Now, simulation.HistoryEdge), budget.IsWorldLate ? SimTime.Min(budget.ChargedSince(player), stands) : stands);
        (double work, double took, double within) = budget.SpentBy(player);
        string cost = PlayerExpulsion.CostOf(work, took, within);
        bool wasThere = roster.Seated(player) is not null;
        if (roster.Seated(player) is Client client)
        {
            shutOuts.ShutOutForAWhile(roster.KnownOf(client), client.Link.Other.Machine, now);
            roster.Expel(client, $"What it did {cost}");
        }

        IReadOnlyList<BodyId> costly = budget.CostlyBodiesOf(player);
        int removed = removal.RemoveSpawned(player == WorkBudget.Departed ? costly.Where(body => body.Sequence > 0) : null, player, from);
        int stopped = Stop(player, costly, from);
        budget.Restart(now);
        byte number = player == WorkBudget.Departed ? (byte)0 : player;
        Expelled?.Invoke(new PlayerExpulsion(number, wasThere, cost, work, took, removed, stopped, from));
    }

    /// <summary>Stops bodies that a player moved and that are not its own; returns how many.</summary>
    private int Stop(byte player, IReadOnlyList<BodyId> costly, SimTime from)
    {
        ILookup<BodyId, SimTime> touched = acts.Of(player, from);
        int stopped = 0;
        int stops = 0;
        foreach (BodyId body in costly.Concat(touched.Select(act => act.Key)).Distinct().Where(MayBeStopped))
        {
            // Before the player's first action on it, and right after each one.
            SimTime[] times = [from, .. touched[body].Distinct().OrderBy(time => time).Select(time => time + SimDuration.OneTick)];
            for (int n = 0; n < times.Length && stops < MaxStops; n++, stops++)
            {
                actions.Do(PlayerAction.SetVelocity(body, Vector3D.Zero), times[n]);
            }

            stopped++;
        }

        return stopped;

        bool MayBeStopped(BodyId body) => body.Peer != player && (player != WorkBudget.Departed || body.Sequence == 0);
    }
}
