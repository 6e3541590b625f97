using System;
using System.Collections.Generic;
using System.Text;
using System.Threading;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Recordings;

/// <summary>
/// The result of replaying a recording: its scene with the accepted events, and every committed state checked against its hashes.
/// </summary>
/// <remarks>
/// <para>By the invariant the state is a fold of the scene over the accepted events. So a replay gives the recorded hashes whatever the
/// network did, unless the recording peer departed from the invariant. For a peer that joined late it starts from the same snapshot as that
/// peer.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class RecordingReplay
{
    private const int MaxNamed = 5;

    private RecordingReplay(
        ReplayOutcome outcome, int eventsApplied, int statesChecked, SimTime? agreedUpTo, CommittedState? expected, CommittedState? actual, string message)
    {
        Outcome = outcome;
        EventsApplied = eventsApplied;
        StatesChecked = statesChecked;
        AgreedUpTo = agreedUpTo;
        Expected = expected;
        Actual = actual;
        Message = message;
    }

    /// <summary>The outcome.</summary>
    public ReplayOutcome Outcome { get; }

    /// <summary>The number of accepted events applied to the world.</summary>
    public int EventsApplied { get; }

    /// <summary>The number of committed states whose hashes match the recorded ones.</summary>
    public int StatesChecked { get; }

    /// <summary>The time of the last committed state that matches; null if none does.</summary>
    public SimTime? AgreedUpTo { get; }

    /// <summary>The first committed state that differs, as recorded; otherwise the last that was checked, or null if none was.</summary>
    public CommittedState? Expected { get; }

    /// <summary>The replay's version of it.</summary>
    public CommittedState? Actual { get; }

    /// <summary>The result as text: one or several sentences, and the extent of the recording if it was replayed.</summary>
    public string Message { get; }

    /// <summary>
    /// The world as the replay left it, at the time of <see cref="Actual"/> if that is not null; null if it could not be run.
    /// </summary>
    internal Simulation? World { get; private set; }

    /// <summary>Replays a recording, up to its last committed state or to the first that differs.</summary>
    /// <param name="recording">The recording. If it is not whole, what there is of it is replayed.</param>
    /// <param name="cancellation">Cancels the replay between two instants of the world.</param>
    /// <remarks>
    /// Events are applied in time order, each just before it happens, and history is dropped at once, so the memory is that of the world at
    /// one instant. Cost: that of the simulation. A scene may need more simulation than anyone can wait for, hence the cancellation.
    /// </remarks>
    /// <exception cref="ArgumentNullException">The recording is null.</exception>
    /// <exception cref="OperationCanceledException">The token was cancelled.</exception>
    public static RecordingReplay Run(Recording recording, CancellationToken cancellation = default) =>
        Run(recording ?? throw new ArgumentNullException(nameof(recording)), SimTime.MaxValue, cancellation);

    /// <summary>Replays a recording no further than to the committed states of <paramref name="until"/>.</summary>
    internal static RecordingReplay Run(Recording recording, SimTime until, CancellationToken cancellation)
    {
        int applied = 0;
        int agreed = 0;
        CommittedState? last = null;
        Simulation simulation;
        try
        {
            simulation = Begin(recording, cancellation);
            int[] order = AcceptedByTime(recording);
            foreach (CommittedState expected in recording.CommittedArray)
            {
                if (expected.Time > until)
                {
                    break;
                }

                while (applied < order.Length && recording.EntryArray[order[applied]].Event.Time <= expected.Time)
                {
                    cancellation.ThrowIfCancellationRequested();
                    Submit(simulation, recording.EntryArray[order[applied]]);
                    applied++;
                }

                cancellation.ThrowIfCancellationRequested();
                simulation.AdvanceTo(expected.Time);
                simulation.DropHistoryBefore(expected.Time);
                CommittedState actual = new(expected.Time, simulation.StateHash(expected.Time), simulation.EventHash(expected.Time));
                if (!actual.Equals(expected))
                {
                    return new RecordingReplay(
                        ReplayOutcome.Differs, applied, agreed, last?.Time, expected, actual,
                        $"The replay differs at {Words.SinceStart(expected.Time, recording.Header!.Start)}: recorded {expected}; replayed {actual}."
                            + SuspectsOf(simulation, recording, expected, actual, last?.Time ?? recording.Joined?.Time)
                            + Holds(recording))
                    {
                        World = simulation,
                    };
                }

                last = expected;
                agreed++;
            }
        }
        catch (Exception failure) when (failure is SceneException or SimulationException)
        {
            return new RecordingReplay(
                ReplayOutcome.CannotRun, applied, agreed, last?.Time, last, last, $"The recording cannot be run again. {failure.Message}");
        }

        return last is CommittedState end
            ? new RecordingReplay(
                ReplayOutcome.Agrees, applied, agreed, end.Time, end, end,
                $"The replay agrees: {Words.Count(agreed, "committed state")} up to {Words.SinceStart(end.Time, recording.Header!.Start)}, with"
                + $" {Words.Count(applied, "accepted event")}; {end}." + Holds(recording))
            {
                World = simulation,
            }
            : new RecordingReplay(
                ReplayOutcome.NothingToCheck, applied, agreed, null, null, null,
                "The recording holds no committed state that a replay could be checked against." + Holds(recording));
    }

    private static string Holds(Recording recording) => " The recording " + recording.Extent;

    /// <summary>
    /// Names the bodies that the difference can stem from. Hashes do not show it, but everything agreed up to the last equal state, so the
    /// difference arose in what happened since.
    /// </summary>
    private static string SuspectsOf(
        Simulation replayed, Recording recording, in CommittedState expected, in CommittedState actual, SimTime? agreed)
    {
        SimTime start = recording.Header!.Start;
        StringBuilder named = new();
        int count = 0;
        for (int n = 0; n < replayed.BodyCount; n++)
        {
            BodyId body = replayed.BodyAt(n);
            IReadOnlyList<TimelineEntry> kept = replayed.Timeline(body);
            if (kept[kept.Count - 1].Key.Time > (agreed ?? start))
            {
                named.Append(count < MaxNamed ? (count == 0 ? ": " : ", ") + Words.Named(replayed.Scene, body) : count == MaxNamed ? ", ..." : "");
                count++;
            }
        }

        string since = agreed is SimTime time ? $"{Words.SinceStart(time, start)}, the last that agrees" : "the start";
        return (expected.StateHash == actual.StateHash ? " The states are the same; what happened on the way there is not." : "")
            + $" A recording holds hashes, which name no body. Since {since}, the replay has events of {count} of"
            + $" {Words.Count(replayed.BodyCount, "body")}{named}.";
    }

    private static Simulation Begin(Recording recording, CancellationToken cancellation)
    {
        if (recording.Header is RecordingHeader { FoldVersion: int fold, LibraryVersion: string library } && fold != Simulation.FoldVersion)
        {
            throw new SceneException(FormattableString.Invariant(
                $"Its states are of fold version {fold}, by the library {library}; this library computes fold version {Simulation.FoldVersion}, which gives other hashes."));
        }

        if (recording.Header is not RecordingHeader header || recording.Scene is not Scene scene)
        {
            throw new SceneException(recording.SceneError ?? "It has no scene.");
        }

        // Nothing is late here, so no history is needed, and it is dropped at once.
        SimulationOptions options = new(header.Start, SimDuration.OneTick, cancellation: cancellation);
        return recording.Joined?.Snapshot is WorldSnapshot snapshot ? new Simulation(scene, snapshot, options) : new Simulation(scene, options);
    }

    /// <summary>
    /// Returns the accepted entries that are not in a snapshot, by the time of their events and then by their place in the log.
    /// </summary>
    private static int[] AcceptedByTime(Recording recording)
    {
        LogEntry[] entries = recording.EntryArray;
        SimTime? joined = recording.Joined?.Time;
        int[] order = new int[entries.Length];
        int count = 0;
        for (int i = 0; i < entries.Length; i++)
        {
            if (entries[i].IsAccepted && !(entries[i].Event.Time < joined))
            {
                order[count++] = i;
            }
        }

        Array.Resize(ref order, count);
        Array.Sort(order, (a, b) =>
        {
            int compared = entries[a].Event.Time.CompareTo(entries[b].Event.Time);
            return compared != 0 ? compared : a.CompareTo(b);
        });
        return order;
    }

    private static void Submit(Simulation simulation, in LogEntry entry)
    {
        SimTime before = entry.Event.Time - SimDuration.OneTick;
        if (before > simulation.SimulatedTo)
        {
            simulation.AdvanceTo(before); // so that the world never holds more than the events of one instant
        }

        SubmitResult result;
        try
        {
            result = simulation.Submit(entry.Event);
        }
        catch (SceneException refused)
        {
            throw new SceneException($"Entry {entry.Index} of its log is accepted, and may not enter the world: {refused.Message}", refused);
        }

        if (result == SubmitResult.TooOld)
        {
            throw new SceneException($"Entry {entry.Index} of its log is accepted, and lies before the start: {entry.Event}.");
        }
    }
}
