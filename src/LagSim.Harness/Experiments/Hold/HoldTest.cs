using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>A session in which one peer's hand grabs, moves and throws the ball. The other peers see that late and heal.</summary>
public static class HoldTest
{
    /// <summary>The peer with the hand: the first client, so that its events need the host's verdict.</summary>
    public const int Holder = 1;

    /// <summary>The lead of the start, so that every peer receives it in time: 2 s one way, and again for lost datagrams.</summary>
    private static readonly SimDuration StartLead = SimDuration.FromSeconds(5);

    private static readonly Vector3D Nowhere = new(double.NaN, double.NaN, double.NaN);

    /// <summary>Validates a hold before anything runs.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The length is out of range.</exception>
    /// <exception cref="HandMotionException">The motion is too fast, or goes too deep.</exception>
    public static void Check(HoldOptions options)
    {
        ArgumentNullException.ThrowIfNull(options);
        _ = new HandCourse(options.Motion, options.HoldSeconds);
    }

    /// <summary>Runs it. In virtual time the same options give the same figures.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time with the shared time since the start of the scene.</param>
    /// <exception cref="ArgumentOutOfRangeException">The hold's length is out of range.</exception>
    /// <exception cref="HandMotionException">The motion is too fast, or goes too deep.</exception>
    /// <exception cref="PeerGroupException">The peers did not connect, or one dropped out.</exception>
    /// <exception cref="OperationCanceledException">Its options asked for an end.</exception>
    public static HoldRun Run(HoldOptions options, Action<SimDuration>? progress = null)
    {
        ArgumentNullException.ThrowIfNull(options);
        HandCourse course = new(options.Motion, options.HoldSeconds);
        PeerGroupOptions group = new(options.Peers, options.Link, options.Strategy, options.Seed, options.Length)
        {
            DisplayDelay = options.DisplayDelay,
            Cancellation = options.Cancellation,
            Carrier = options.Carrier,
            StartLead = StartLead,
        };
        Scene scene = HoldOptions.BuildScene();
        using PeerGroup peers = options.IsVirtual ? new VirtualPeers(scene, group) : new RealPeers(scene, group);
        peers.Connect();
        HoldSession session = new(peers, course, progress);
        session.Play(options);
        return Measure(options, peers, course, session);
    }

    private static HoldRun Measure(HoldOptions options, PeerGroup peers, HandCourse course, HoldSession session)
    {
        SampleGrid grid = peers.Grid;
        int last = grid.Count - 1;
        Simulation truth = GroupFigures.Truth(peers, session.LateEvents.Accepted, options.Cancellation);
        IReadOnlyList<(SimTime Stamp, SimTime Dealt)> windows = session.LateEvents.Windows;
        Phase[] phases = Instants(n => LateEventWatch.PhaseAt(windows, grid.At(n)));
        Vector3D[] hand = Instants(n => session.HandAt(grid.At(n)) ?? Nowhere);
        int first = grid.FirstAfter(session.MotionStart), end = grid.FirstAfter(session.ThrowStart);
        int[] others = Enumerable.Range(0, peers.PeerCount).Where(place => place != Holder).ToArray();
        List<HeldView> views = [];
        List<Vector3D[]> drawn = [];
        foreach (int place in others)
        {
            views.Add(View(peers, session, place, hand, first, end, out Vector3D[] at));
            drawn.Add(at);
        }

        long keyframes = session.LateEvents.Accepted.Count(e => e.Kind == EventKind.HoldKeyframe);
        long during = session.LateEvents.Accepted.Count(e => e.Kind == EventKind.HoldKeyframe && e.Time >= session.MotionStart && e.Time < session.ThrowStart);
        return new HoldRun(
            options,
            Errors(peers.Seen),
            Errors(peers.SeenTrueTime),
            Errors(peers.Settled),
            GroupFigures.StateHashes(peers, last),
            GroupFigures.EventHashes(peers, last),
            truth.StateHash(grid.At(last)),
            truth.EventHash(grid.At(last)),
            peers.Scene.Hash,
            peers.ClockErrorMilliseconds.Max(),
            GroupFigures.HostEvents(peers, 0, grid.Count).Count(),
            GroupFigures.Heals(peers),
            GroupFigures.BytesPerSecond(session.TrafficAtStart, session.TrafficAtEnd, options.Length.ToSeconds()),
            Percentiles.Of(GroupFigures.Latenesses(peers)),
            peers.CpuCoresAtRest,
            keyframes,
            during / (session.ThrowStart - session.MotionStart).ToSeconds(),
            (session.TrafficAtThrow.BytesSent - session.TrafficAtMotion.BytesSent) / course.Seconds,
            (session.TrafficAtThrow.BytesReceived - session.TrafficAtMotion.BytesReceived) / course.Seconds,
            Off(peers.Seen[Holder], hand, first, end),
            views,
            session.LateEvents.Accepted,
            new HoldTrace(
                Instants(n => (grid.At(n) - peers.Start).ToSeconds()),
                hand,
                peers.Seen.Select(seen => Instants(n => seen.IsShown(n) ? seen.State(n, 0).Position : Nowhere)).ToArray(),
                drawn.ToArray(),
                Distances(peers.Seen),
                Distances(peers.Settled),
                Since(session.Grab),
                Since(session.MotionStart),
                Since(session.ThrowStart),
                Since(session.Release),
                windows[^1].Dealt == SimTime.MaxValue ? null : Since(windows[^1].Dealt)));

        PhaseErrors Errors(IReadOnlyList<PeerSamples> samples) => PeerComparison.Errors(samples, peers.Bodies.Length, 0, grid.Count, n => phases[n]);

        double[] Distances(IReadOnlyList<PeerSamples> samples) => Instants(n => PeerComparison.Distance(samples, peers.Bodies.Length, n, out _));

        double Since(SimTime time) => (time - peers.Start).ToSeconds();

        T[] Instants<T>(Func<int, T> of) => Array.ConvertAll(Enumerable.Range(0, grid.Count).ToArray(), n => of(n));
    }

    /// <summary>
    /// Replays, frame by frame, what another peer saw and would have seen with the predictor, with each event at the time it arrived.
    /// </summary>
    private static HeldView View(PeerGroup peers, HoldSession session, int place, Vector3D[] hand, int first, int end, out Vector3D[] drawn)
    {
        IReadOnlyList<HandUpdate> heard = session.Hand.HeardBy(place);
        HandView view = new();
        ErrorAccumulator predicted = new();
        double[] candidates = new double[AdaptivePredictor.Candidates.Count];
        drawn = new Vector3D[peers.Grid.Count];
        int next = 0;
        for (int n = 0; n < drawn.Length; n++)
        {
            SimTime now = peers.Grid.At(n);
            for (; next < heard.Count && heard[next].Heard <= now; next++)
            {
                if (heard[next].Event.Kind == EventKind.HoldKeyframe)
                {
                    view.Hear(heard[next]);
                }
            }

            bool isDrawn = view.TryDraw(now, out Vector3D at) && hand[n].IsFinite;
            drawn[n] = isDrawn ? at : Nowhere;
            if (n < first || n >= end)
            {
                continue;
            }

            if (!isDrawn)
            {
                predicted.AddStalled();
                continue;
            }

            Add(predicted, at, hand[n]);
            for (int candidate = 0; candidate < candidates.Length; candidate++)
            {
                candidates[candidate] += (view.DrawnBy(candidate, now) - hand[n]).LengthSquared;
            }
        }

        ErrorStatistics adaptive = predicted.ToStatistics();
        double[] alone = candidates.Select(sum => Math.Sqrt(sum / Math.Max(adaptive.Samples, 1))).ToArray();
        return new HeldView(place, Off(peers.Seen[place], hand, first, end), adaptive, alone);
    }

    /// <summary>Returns how far from the hand a peer showed the ball.</summary>
    private static ErrorStatistics Off(PeerSamples seen, Vector3D[] hand, int first, int end)
    {
        ErrorAccumulator errors = new();
        for (int n = first; n < end; n++)
        {
            if (seen.IsShown(n))
            {
                Add(errors, seen.State(n, 0).Position, hand[n]);
            }
            else
            {
                errors.AddStalled();
            }
        }

        return errors.ToStatistics();
    }

    private static void Add(ErrorAccumulator errors, in Vector3D shown, in Vector3D hand) => errors.Add((shown - hand).Length, !shown.Equals(hand));
}
