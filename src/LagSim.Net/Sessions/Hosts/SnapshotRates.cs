using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Limits how fast each machine is sent snapshot chunks, with one pace for all its clients, reconnecting ones included.</summary>
/// <remarks>
/// With a pace for each client, a machine that joins a hundred times would get a hundred times as much. Little is remembered: a machine
/// that has not asked for a moment has its full pace again, and is forgotten.
/// </remarks>
internal sealed class SnapshotRates
{
    /// <summary>The number of machines above which those with a full pace are looked for.</summary>
    private const int Many = 64;

    private readonly Dictionary<PeerAddress, RateLimit> paces = new();
    private readonly List<PeerAddress> rested = new();
    private readonly JoinLimits limits;

    internal SnapshotRates(JoinLimits limits) => this.limits = limits;

    /// <summary>The number of machines remembered.</summary>
    internal int Count => paces.Count;

    /// <summary>Whether an address may have another chunk now; if so, it is counted.</summary>
    internal bool TrySpend(PeerAddress to, SimTime now)
    {
        PeerAddress machine = to.Machine;
        if (!paces.TryGetValue(machine, out RateLimit? pace))
        {
            Forget(now);
            paces[machine] = pace = new RateLimit(limits.ChunksPerSecond, limits.ChunkBurst, now);
        }

        return pace.TrySpend(now);
    }

    private void Forget(SimTime now)
    {
        if (paces.Count < Many)
        {
            return;
        }

        rested.Clear();
        foreach (KeyValuePair<PeerAddress, RateLimit> pace in paces)
        {
            if (pace.Value.IsWhole(now))
            {
                rested.Add(pace.Key);
            }
        }

        foreach (PeerAddress machine in rested)
        {
            paces.Remove(machine);
        }
    }
}
