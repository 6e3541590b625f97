using System;
using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Limits how often something is done for each machine, with one limit for all its clients, reconnecting ones included.</summary>
/// <remarks>
/// With a limit for each client, a machine that joins a hundred times would get a hundred times as much. Little is remembered: a machine
/// that has not asked for a moment has its full limit again, and is forgotten.
/// </remarks>
internal sealed class MachineRates
{
    /// <summary>
    /// The number of machines from which on those with a full limit are forgotten; after that when there are twice as many, or after a
    /// pause, so that a flood of machines costs little for each.
    /// </summary>
    private const int Many = 64;

    private static readonly SimDuration Pause = SimDuration.FromSeconds(10);

    private readonly Dictionary<PeerAddress, RateLimit> limits = new();
    private readonly List<PeerAddress> rested = new();
    private readonly double perSecond;
    private readonly int burst;
    private int forgetAt = Many;
    private SimTime forgetAfter = SimTime.MinValue;

    /// <param name="perSecond">How often a second.</param>
    /// <param name="burst">How often at once after a pause.</param>
    internal MachineRates(double perSecond, int burst)
    {
        this.perSecond = perSecond;
        this.burst = burst;
    }

    /// <summary>The number of machines remembered.</summary>
    internal int Count => limits.Count;

    /// <summary>Whether it may be done once more now for an address; if so, it is counted.</summary>
    internal bool TrySpend(PeerAddress to, SimTime now)
    {
        PeerAddress machine = to.Machine;
        if (!limits.TryGetValue(machine, out RateLimit? limit))
        {
            Forget(now);
            limits[machine] = limit = new RateLimit(perSecond, burst, now);
        }

        return limit.TrySpend(now);
    }

    private void Forget(SimTime now)
    {
        if (limits.Count < forgetAt && (limits.Count < Many || now < forgetAfter))
        {
            return;
        }

        rested.Clear();
        foreach (KeyValuePair<PeerAddress, RateLimit> one in limits)
        {
            if (one.Value.IsWhole(now))
            {
                rested.Add(one.Key);
            }
        }

        foreach (PeerAddress machine in rested)
        {
            limits.Remove(machine);
        }

        forgetAt = Math.Max(Many, 2 * limits.Count);
        forgetAfter = now + Pause;
    }
}
