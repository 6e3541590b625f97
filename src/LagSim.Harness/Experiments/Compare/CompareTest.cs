using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.Reports;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>Plays a plan with one strategy on one link, in virtual time, and measures what every peer showed.</summary>
public static class CompareTest
{
    /// <summary>The lead of the start, so that every peer receives it in time: 2 s one way, and again for lost datagrams.</summary>
    private static readonly SimDuration StartLead = SimDuration.FromSeconds(5);

    /// <summary>Runs it. The same options give the same figures, except the time to heal.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time with the shared time since the start of the scene.</param>
    /// <exception cref="SceneException">There are more bodies than can be recorded, or a player may not do what the plan says.</exception>
    /// <exception cref="PeerGroupException">The peers did not connect, or one dropped out.</exception>
    /// <exception cref="OperationCanceledException">Its options asked for an end.</exception>
    public static CompareRun Run(CompareOptions options, Action<SimDuration>? progress = null)
    {
        ArgumentNullException.ThrowIfNull(options);
        BodyId[] spawned = options.Plan.Where(action => action.Kind == EventKind.Spawn).Select(action => action.Body).ToArray();
        int bodies = options.Scene.Bodies.Count + spawned.Length;
        if (bodies > CompareOptions.MaxBodies)
        {
            throw new SceneException($"The scene '{options.Scene.Name}' has {NumberText.Count(bodies, "body", many: "bodies")} with those that will be"
                + $" spawned; at most {CompareOptions.MaxBodies} are watched.");
        }

        PeerGroupOptions group = new(options.Peers, options.Link, options.Strategy, options.Seed, CompareOptions.Length)
        {
            DisplayDelay = options.DisplayDelay,
            Cancellation = options.Cancellation,
            StartLead = StartLead,
            Spawned = spawned,
        };
        using VirtualPeers peers = new(options.Scene, group);
        peers.Connect();
        LateEventWatch watch = new(peers);
        HealWatch heals = new(peers);
        InputWatch inputs = new(peers);
        PortTraffic[] before = GroupFigures.Traffic(peers);
        foreach (PlannedAction action in options.Plan)
        {
            peers.RunUntil(action.Time, progress);
            int peer = PlaceOf(peers, action.Peer);
            Action<SimTime> noted = inputs.Expect(peer, action.Body);
            ExternalEvent external = heals.Own(() => peers.Do(peer, action.ToAction()));
            noted(external.Time);
            watch.Did(external);
        }

        peers.RunQuietlyUntil(CompareOptions.Length, progress);
        PortTraffic[] after = GroupFigures.Traffic(peers);
        peers.Finish();
        double seconds = CompareOptions.Length.ToSeconds();
        return Measure(options, peers, watch, heals, inputs, GroupFigures.BytesPerSecond(before, after, seconds));
    }

    private static string NameOf(Scene scene, BodyId body) => body == BodyId.OfScene(body.Index) ? scene.Bodies[body.Index].Name : body.ToString();

    /// <summary>The place in the group of a player's number. Clients get their numbers in the order in which they join.</summary>
    private static int PlaceOf(PeerGroup peers, int number) => Enumerable.Range(0, peers.PeerCount).Single(p => peers.Session(p).Peer == number);

    private static CompareRun Measure(CompareOptions options, VirtualPeers peers, LateEventWatch watch, HealWatch heals, InputWatch inputs, double[] bytes)
    {
        SampleGrid grid = peers.Grid;
        int last = grid.Count - 1;
        Simulation truth = GroupFigures.Truth(peers, watch.Accepted, options.Cancellation);
        PeerSamples onTime = new(grid, peers.Bodies);
        onTime.TakeSettled(truth);
        PeerSamples[] fromTruth = [onTime, .. peers.Seen];
        IReadOnlyList<(SimTime Stamp, SimTime Dealt)> windows = watch.Windows;
        SettledDifference? difference = PeerComparison.FirstDifference([onTime, .. peers.Settled], peers.Bodies.Length, grid.Count) is (int instant, int who, int which)
            ? new SettledDifference((grid.At(instant) - peers.Start).ToSeconds(), who - 1, NameOf(options.Scene, peers.Bodies[which]))
            : null;
        Phase[] phases = Instants(n => LateEventWatch.PhaseAt(windows, grid.At(n)));
        return new CompareRun(
            options,
            Errors(peers.Seen),
            Errors(peers.SeenTrueTime),
            Errors(fromTruth),
            Errors(peers.Settled),
            GroupFigures.StateHashes(peers, last),
            GroupFigures.EventHashes(peers, last),
            truth.StateHash(grid.At(last)),
            truth.EventHash(grid.At(last)),
            peers.ClockErrorMilliseconds.Max(),
            GroupFigures.HostEvents(peers, 0, grid.Count).Count(),
            GroupFigures.Heals(peers),
            bytes,
            Percentiles.Of(GroupFigures.Latenesses(peers)),
            Percentiles.Of(windows.Where(w => w.Dealt != SimTime.MaxValue).Select(w => (w.Dealt - w.Stamp).ToMilliseconds())),
            Percentiles.Of(heals.Milliseconds),
            MeanAndTail.Of(heals.Reports.Select(report => (double)report.Events).ToList()),
            MeanAndTail.Of(heals.Reports.Select(report => (double)report.Bodies).ToList()),
            Percentiles.Of(heals.Jumps),
            heals.Jumps.Count,
            Percentiles.Of(inputs.Milliseconds()),
            new CompareTrace(
                Instants(n => (grid.At(n) - peers.Start).ToSeconds()),
                Distances(peers.Seen),
                Distances(fromTruth),
                Distances(peers.Settled),
                windows.Select(w => ((w.Stamp - peers.Start).ToSeconds(), w.Dealt == SimTime.MaxValue ? (double?)null : (w.Dealt - peers.Start).ToSeconds())).ToList()))
        {
            FirstDifference = difference,
        };

        PhaseErrors Errors(IReadOnlyList<PeerSamples> samples) => PeerComparison.Errors(samples, peers.Bodies.Length, 0, grid.Count, n => phases[n]);

        double[] Distances(IReadOnlyList<PeerSamples> samples) => Instants(n => PeerComparison.Distance(samples, peers.Bodies.Length, n, out _));

        T[] Instants<T>(Func<int, T> of) => Array.ConvertAll(Enumerable.Range(0, grid.Count).ToArray(), n => of(n));
    }
}
