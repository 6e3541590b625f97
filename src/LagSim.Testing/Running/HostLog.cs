using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>What a host said of every event of its session.</summary>
internal sealed class HostLog
{
    private readonly List<ExternalEvent> accepted = [];
    private readonly List<uint> acceptedEntries = [];

    /// <summary>The accepted events, in the order of the log.</summary>
    internal IReadOnlyList<ExternalEvent> Accepted => accepted;

    /// <summary>The numbers of their entries.</summary>
    internal IReadOnlyList<uint> AcceptedEntries => acceptedEntries;

    /// <summary>How many events were not accepted, whatever the reason.</summary>
    internal long Refused { get; private set; }

    /// <summary>How many of them were too late.</summary>
    internal long TooLate { get; private set; }

    /// <summary>Listens to the host, from before it is stepped.</summary>
    internal void Follow(Session host) => host.Logged += Take;

    /// <summary>The world that had every accepted event before it began.</summary>
    /// <param name="scene">The session's scene.</param>
    /// <param name="options">What it is run with.</param>
    /// <param name="end">How far it is simulated.</param>
    /// <exception cref="SimulationException">It cannot be simulated as far.</exception>
    internal Simulation Replay(Scene scene, SimulationOptions options, SimTime end)
    {
        Simulation alone = new(scene, options);
        foreach (ExternalEvent external in accepted)
        {
            alone.Submit(external);
        }

        alone.AdvanceTo(end);
        return alone;
    }

    private void Take(LogEntry entry)
    {
        if (entry.Verdict == Verdict.Accepted)
        {
            accepted.Add(entry.Event);
            acceptedEntries.Add(entry.Index);
            return;
        }

        Refused++;
        TooLate += entry.Verdict == Verdict.TooLate ? 1 : 0;
    }
}
