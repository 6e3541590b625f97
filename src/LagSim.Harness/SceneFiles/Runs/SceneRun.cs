using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>One run of a scene in virtual time, with its events and samples reported as it advances.</summary>
public sealed class SceneRun
{
    /// <summary>
    /// The largest advance is a quarter of the history, so that everything since the last one is still there to report.
    /// </summary>
    private const int StridesInHistory = 4;

    /// <summary>
    /// The largest number of events of an advance is this or four a body. The state of a body before an event is read back from its newest
    /// event, so more at a time would cost the square of their number, and fewer would visit most bodies without need.
    /// </summary>
    private const long EventsAtOnce = 256;

    /// <summary>The number of parts of a timed run, so few that starting and stopping the watch costs nothing.</summary>
    private const int TimedParts = 20;

    private const string Impact = "impact";

    private readonly Scene scene;
    private readonly MotionLaw[] lastLaw;
    private readonly List<BodyEvent> pending = [];

    /// <summary>Creates a run of the scene without starting it.</summary>
    public SceneRun(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        this.scene = scene;
        lastLaw = new MotionLaw[scene.Bodies.Count];
    }

    /// <summary>Called for every event and body it touched, in canonical order.</summary>
    public Action<BodyEvent>? OnEvent { get; init; }

    /// <summary>Called with the world at every sample's time, the start included.</summary>
    public Action<SimTime, Simulation>? OnSample { get; init; }

    /// <summary>
    /// The interval of samples, in seconds; at least 1e-9. Each sample's time is rounded to a tick by itself, so no error adds up.
    /// </summary>
    public double SampleEverySeconds { get; init; } = 0.01;

    /// <summary>
    /// The history that the simulation keeps; default 1 s, at least 4 ticks. Its memory depends on the events in it, not on the run's
    /// length.
    /// </summary>
    public SimDuration History { get; init; } = SimDuration.FromSeconds(1);

    /// <summary>Cancels the run with an <see cref="OperationCanceledException"/>; default never.</summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>Runs the scene and returns the world at its end.</summary>
    public Simulation Run(SimDuration length, Action<SimDuration>? progress = null)
    {
        SimTime end = SimTime.Zero + length;
        Simulation simulation = new(scene, new SimulationOptions(SimTime.Zero, History, cancellation: Cancellation));
        SimDuration stride = History / StridesInHistory;
        SimTime reported = SimTime.Zero - SimDuration.OneTick;
        SimTime sample = SimTime.Zero;
        long samples = 0;
        SimTime now = SimTime.Zero;
        while (true)
        {
            bool isThere;
            do
            {
                long events = OnEvent is null ? long.MaxValue : Math.Max(EventsAtOnce, 4 * scene.Bodies.Count);
                isThere = simulation.TryAdvanceTo(now, ref events);
                Report(simulation, reported, simulation.SimulatedTo);
                reported = simulation.SimulatedTo;
            }
            while (!isThere);

            if (OnSample is not null && now == sample)
            {
                OnSample(now, simulation);
                sample = SimTime.FromSeconds(++samples * SampleEverySeconds);
            }

            progress?.Invoke(now - SimTime.Zero);
            if (now == end)
            {
                return simulation;
            }

            // Nothing happens up to the horizon, so a world at rest takes no time.
            SimTime next = SimTime.Min(end, SimTime.Max(now + stride, simulation.Horizon));
            now = OnSample is null ? next : SimTime.Min(next, sample);
        }
    }

    /// <summary>Returns the least wall-clock seconds of several runs of the simulation alone, after a warm-up.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="length">The simulated length.</param>
    /// <param name="times">The number of timed runs.</param>
    /// <param name="progress">Called with the number of simulated seconds in all runs so far. Its own time does not count.</param>
    /// <param name="isWarm">Whether the code is already warm, so that no warm-up is needed.</param>
    /// <param name="history">The history that each run keeps; null for 1 s.</param>
    /// <param name="cancellation">Ends it early, by an <see cref="OperationCanceledException"/>.</param>
    public static double MinSeconds(
        Scene scene, SimDuration length, int times, Action<double>? progress = null, bool isWarm = false, SimDuration? history = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(scene);
        SimTime end = SimTime.Zero + length;
        SimDuration stride = SimDuration.FromTicks(Math.Max(1, length.Ticks / TimedParts));
        double least = double.MaxValue;
        int before = isWarm ? 0 : 1;
        for (int i = 0; i < before + times; i++)
        {
            long began = Stopwatch.GetTimestamp();
            Simulation simulation = new(scene, new SimulationOptions(history: history, cancellation: cancellation));
            TimeSpan spent = Stopwatch.GetElapsedTime(began);
            do
            {
                began = Stopwatch.GetTimestamp();
                simulation.AdvanceTo(SimTime.Min(end, simulation.SimulatedTo + stride));
                spent += Stopwatch.GetElapsedTime(began);
                progress?.Invoke((i * length.ToSeconds()) + (simulation.SimulatedTo - SimTime.Zero).ToSeconds());
            }
            while (simulation.SimulatedTo < end);

            least = i < before ? least : Math.Min(least, spent.TotalSeconds);
        }

        return least;
    }

    private void Report(Simulation simulation, SimTime after, SimTime upTo)
    {
        if (OnEvent is null)
        {
            return;
        }

        pending.Clear();
        for (int body = 0; body < scene.Bodies.Count; body++)
        {
            BodyId id = BodyId.OfScene(body);
            TimelineEntry? last = null;
            foreach (TimelineEntry entry in simulation.Timeline(id, after))
            {
                if (entry.Key.Time > after && entry.Key.Time <= upTo)
                {
                    Add(simulation, id, entry, last);
                }

                last = entry;
            }
        }

        BodyEvent[] inOrder = pending.OrderBy(e => e.Key).ThenBy(e => e.Body).ToArray();
        foreach (BodyEvent happened in inOrder)
        {
            bool isOfBodies = happened.Kind == Impact && happened.Other.Length == 0;
            BodyId? other = isOfBodies ? ImpactPartner.Body(happened, inOrder, scene) : null;
            OnEvent(other is BodyId partner ? happened with { Other = partner.Sequence == 0 ? scene.Bodies[partner.Index].Name : partner.ToString() } : happened);
        }
    }

    private void Add(Simulation simulation, BodyId body, in TimelineEntry entry, in TimelineEntry? last)
    {
        MotionLaw before = lastLaw[body.Index];
        MotionLaw law = lastLaw[body.Index] = entry.State.Motion;
        if (entry.Key.Kind is not (EventKind.Start or EventKind.StepEnd) && !WasOnlyAsked(simulation, body, entry, last))
        {
            bool isOfSurface = entry.Key.Kind == EventKind.Impact && entry.Key.Body == entry.Key.Other;
            string surface = isOfSurface
                ? ImpactPartner.Surface(scene, scene.Bodies[body.Index].Spec.Radius, Before(simulation, body, entry, last), entry.State)
                : "";
            pending.Add(new BodyEvent(entry.Key, EventKindText.Of(entry.Key.Kind), body, surface, entry.State));
        }

        if (law == MotionLaw.Resting != (before == MotionLaw.Resting))
        {
            pending.Add(new BodyEvent(entry.Key, law == MotionLaw.Resting ? "rest" : "wake", body, "", entry.State));
        }
    }

    /// <summary>Whether an impact of others was tested against a body, and has left it as it was.</summary>
    private static bool WasOnlyAsked(Simulation simulation, BodyId body, in TimelineEntry entry, in TimelineEntry? last)
    {
        if (entry.Key.Kind != EventKind.Impact || entry.Key.Body == body || entry.Key.Other == body)
        {
            return false;
        }

        BodyState before = Before(simulation, body, entry, last), after = entry.State;
        return before.Motion == after.Motion && before.Spin == after.Spin
            && (after.Velocity - before.Velocity).Length <= 1e-9 * (before.Velocity.Length + simulation.Scene.Gravity.Length);
    }

    /// <summary>Returns the body right before an event: after the event before it, if that is of the same tick, else a tick ago.</summary>
    private static BodyState Before(Simulation simulation, BodyId body, in TimelineEntry entry, in TimelineEntry? last)
    {
        if (last is TimelineEntry earlier && earlier.Key.Time == entry.Key.Time)
        {
            return earlier.State;
        }

        simulation.TryRead(body, entry.Key.Time - SimDuration.OneTick, out BodyState before);
        return before;
    }
}
