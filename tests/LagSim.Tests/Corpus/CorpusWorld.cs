using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Corpus;

/// <summary>A world of the corpus: what a session would have recorded of it, and how its hashes are found.</summary>
/// <param name="Name">The name of its file, without the extension.</param>
/// <param name="Scene">The scene.</param>
/// <param name="Log">What the host accepted or refused, in the order of the log.</param>
/// <param name="Seconds">How long it runs, from <paramref name="Start"/>.</param>
/// <param name="States">How many committed states are recorded, evenly spaced, besides that of the start.</param>
/// <param name="Start">When it starts.</param>
internal sealed record CorpusWorld(string Name, Scene Scene, LogEntry[] Log, double Seconds, int States, SimTime Start)
{
    /// <summary>What happens, all of it accepted, in the order of the log.</summary>
    internal static LogEntry[] Accepted(IEnumerable<ExternalEvent> events) =>
        events.Select((what, i) => new LogEntry((uint)i + 1, Verdict.Accepted, what)).ToArray();

    /// <summary>
    /// The world of one who had all events before it began, and keeps everything. A replay goes another way: it hears of each event just before it
    /// happens, and forgets at once.
    /// </summary>
    internal Simulation Run()
    {
        Simulation simulation = new(Scene, new SimulationOptions(Start, SimDuration.MaxValue));
        foreach (LogEntry entry in Log.Where(entry => entry.Verdict == Verdict.Accepted))
        {
            simulation.Submit(entry.Event);
        }

        simulation.AdvanceTo(Time(States));
        return simulation;
    }

    /// <summary>The recording, as bytes.</summary>
    internal byte[] Record()
    {
        Simulation simulation = Run();
        MemoryStream stream = new();
        using (RecordingWriter writer = new(stream, 0, Scene, Start))
        {
            foreach (LogEntry entry in Log)
            {
                writer.WriteEntry(entry.Index, entry.Verdict, entry.Event);
            }

            for (int i = 0; i <= States; i++)
            {
                writer.WriteCommitted(Time(i), simulation.StateHash(Time(i)), simulation.EventHash(Time(i)));
            }

            writer.WriteEnd("The corpus world ends.");
        }

        return stream.ToArray();
    }

    /// <summary>The instant of a committed state.</summary>
    private SimTime Time(int state) => Start + SimDuration.FromSeconds(Seconds * state / States);
}
