using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>
/// What the hosts of one drawn session said: the log and the committed states of each, one after the other if one was killed.
/// </summary>
internal sealed class StallHostLog
{
    private readonly Dictionary<(SimTime Start, SimTime Time), ulong> states = []; // a restarted host has a world with another start
    private readonly List<(HostSession Host, HashSet<uint> Log)> logs = [];

    /// <summary>How many lines of their logs are accepted events, of all hosts.</summary>
    internal long AcceptedInAll => logs.Sum(log => (long)log.Log.Count);

    /// <summary>How many events the hosts refused, of all hosts.</summary>
    internal long RefusedInAll { get; private set; }

    /// <summary>How many of those because they came too late.</summary>
    internal long TooLateInAll { get; private set; }

    internal void Follow(HostSession host)
    {
        HashSet<uint> log = [];
        logs.Add((host, log));
        host.Logged += entry =>
        {
            if (entry.IsAccepted)
            {
                log.Add(entry.Index);
            }
            else
            {
                RefusedInAll++;
                TooLateInAll += entry.Verdict == Verdict.TooLate ? 1 : 0;
            }
        };
        host.StateCommitted += state => states[(host.World!.Simulation.Start, state.Time)] = state.StateHash;
    }

    /// <summary>The accepted lines of the log of the host that has, or had, the world with that start.</summary>
    internal IReadOnlySet<uint> AcceptedOf(SimTime start) => logs.First(log => log.Host.World?.Simulation.Start == start).Log;

    /// <summary>The host's state of that world at that time, if it got there.</summary>
    internal bool TryGet(SimTime start, SimTime time, out ulong hash) => states.TryGetValue((start, time), out hash);
}
