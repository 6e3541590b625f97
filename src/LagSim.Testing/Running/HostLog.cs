using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Testing.Running;

/// <summary>A recorder of the host's verdicts on every event of a session.</summary>
internal sealed class HostLog
{
    private readonly List<ExternalEvent> accepted = [];
    private readonly List<uint> acceptedEntries = [];
    private Session? followed;
    private SimTime latest = SimTime.MinValue; // of the accepted events

    /// <summary>The accepted events, in the order of the log.</summary>
    internal IReadOnlyList<ExternalEvent> Accepted => accepted;

    /// <summary>The log indices of <see cref="Accepted"/>, in the same order.</summary>
    internal IReadOnlyList<uint> AcceptedEntries => acceptedEntries;

    /// <summary>The number of refused events, whatever the reason.</summary>
    internal long Refused { get; private set; }

    /// <summary>The number of events refused because they were too late.</summary>
    internal long TooLate { get; private set; }

    /// <summary>The number of accepted events that came too late for their stamps, and happened later.</summary>
    internal long Moved { get; private set; }

    /// <summary>Subscribes to the host. Call it before the first step.</summary>
    internal void Follow(Session host)
    {
        followed = host;
        host.Logged += Take;
    }

    /// <summary>
    /// Returns whether a session has heard of every verdict, waits for none, and has simulated every accepted event. The last of them may
    /// lie ahead of all worlds when all have heard of it; a run that ended then would compare its effect nowhere.
    /// </summary>
    internal bool IsSettled(Session session) =>
        session.State == SessionState.Running
        && session.LogLength == followed!.LogLength
        && session is not ClientSession { UnconfirmedEvents: > 0 }
        && session.World!.Simulation.SimulatedTo >= latest;

    /// <summary>Simulates the reference: a world that has every accepted event from the start, as without latency.</summary>
    /// <param name="scene">The session's scene.</param>
    /// <param name="options">The options of the reference.</param>
    /// <param name="end">The time to simulate to.</param>
    /// <exception cref="SimulationException">The reference cannot be simulated to <paramref name="end"/>.</exception>
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
        if (entry.IsAccepted)
        {
            Moved += entry.Verdict == Verdict.Moved ? 1 : 0;
            accepted.Add(entry.Event);
            acceptedEntries.Add(entry.Index);
            latest = SimTime.Max(latest, entry.Event.Time);
            return;
        }

        Refused++;
        TooLate += entry.Verdict == Verdict.TooLate ? 1 : 0;
    }
}
