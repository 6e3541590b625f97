using System.Collections.Generic;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions.Links;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>How fast each machine gets pieces of copies: one pace for all clients of an address, and for those who come again.</summary>
/// <remarks>
/// Were it one for each client, who comes in a hundred times over would get a hundred times as much. What is remembered is small: a machine
/// that has not asked for a moment has all of its pace again, so it is forgotten.
/// </remarks>
internal sealed class CopyPaces
{
    /// <summary>With more machines than this, those that have all of their pace are looked for.</summary>
    private const int Many = 64;

    private readonly Dictionary<PeerAddress, RateLimit> paces = new();
    private readonly List<PeerAddress> rested = new();
    private readonly DoorLimits limits;

    internal CopyPaces(DoorLimits limits) => this.limits = limits;

    /// <summary>How many machines are remembered.</summary>
    internal int Count => paces.Count;

    /// <summary>Whether an address may have another piece now; then it is counted.</summary>
    internal bool TrySpend(PeerAddress to, SimTime now)
    {
        PeerAddress machine = to.Machine;
        if (!paces.TryGetValue(machine, out RateLimit? pace))
        {
            Forget(now);
            paces[machine] = pace = new RateLimit(limits.PiecesPerSecond, limits.PiecesAtOnce, now);
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
