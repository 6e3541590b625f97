using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Drop;

/// <summary>The thesis's drop test: a ball falls in several instances of a world, and one peer lifts it.</summary>
public static class DropTest
{
    /// <summary>The peer that lifts the ball: the first client, so that the event needs the host's verdict.</summary>
    private const int Lifter = 1;

    /// <summary>Runs the test and measures every case.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time with the shared time since the start of the scene.</param>
    /// <exception cref="SceneException">A height or the restitution is out of range.</exception>
    /// <exception cref="PeerGroupException">The peers did not connect.</exception>
    /// <exception cref="OperationCanceledException">The options' token cancelled the run.</exception>
    public static IReadOnlyList<DropRun> Run(DropOptions options, Action<SimDuration>? progress = null)
    {
        ArgumentNullException.ThrowIfNull(options);
        Scene scene = options.BuildScene();
        PeerGroupOptions group = new(options.Peers, options.Link, options.Strategy, options.Seed, options.Length)
        {
            Carrier = options.Carrier,
            DisplayDelay = options.DisplayDelay,
            Cancellation = options.Cancellation,
        };
        using PeerGroup peers = options.IsVirtual ? new VirtualPeers(scene, group) : new RealPeers(scene, group);
        peers.Connect();

        PortTraffic[] atStart = GroupFigures.Traffic(peers);
        PortTraffic[] atLift = atStart;
        ExternalEvent lifted = default;
        if (options.Lift is SimDuration lift)
        {
            peers.RunUntil(lift, progress);
            atLift = GroupFigures.Traffic(peers);
            lifted = peers.Do(Lifter, PlayerAction.Teleport(BodyId.OfScene(0), new Vector3D(0, options.SecondHeightMetres, 0)));
        }

        peers.RunQuietlyUntil(options.Length, progress);
        PortTraffic[] atEnd = GroupFigures.Traffic(peers);
        peers.Finish();

        List<DropRun> runs = [];
        foreach (DropCase which in options.Cases)
        {
            bool first = which == options.Cases[0];
            bool last = which == options.Cases[^1];
            runs.Add(Measure(peers, options, which, lifted, first ? atStart : atLift, last ? atEnd : atLift));
        }

        return runs;
    }

    private static DropRun Measure(
        PeerGroup peers, DropOptions options, DropCase which, in ExternalEvent lifted, PortTraffic[] trafficBefore, PortTraffic[] trafficAfter)
    {
        (SimDuration from, SimDuration to) = options.Window(which);
        bool isTeleport = which == DropCase.Teleport;
        SimTime? stamp = isTeleport ? lifted.Time : null;
        SimTime dealt = isTeleport ? LastDealt(peers, lifted.Time) : peers.Start;
        bool isAlone = options.Cases.Count == 1;
        int first = isTeleport && !isAlone ? BeforeLift(peers, options, lifted) : peers.Grid.FirstAfter(peers.Start + from);
        int end = isTeleport || isAlone ? peers.Grid.FirstAfter(peers.Start + to) : BeforeLift(peers, options, lifted);
        double seconds = (to - from).ToSeconds();

        return new DropRun(
            which,
            options,
            Errors(peers.Seen),
            Errors(peers.SeenTrueTime),
            Errors(peers.Settled),
            GroupFigures.StateHashes(peers, end - 1),
            GroupFigures.EventHashes(peers, end - 1),
            peers.Scene.Hash,
            end > first ? peers.ClockErrorMilliseconds[first..end].Max() : 0,
            GroupFigures.HostEvents(peers, first, end).Count(),
            isTeleport ? GroupFigures.Heals(peers) : 0,
            GroupFigures.BytesPerSecond(trafficBefore, trafficAfter, seconds),
            Percentiles.Of(isTeleport ? GroupFigures.Latenesses(peers) : []),
            which == options.Cases[^1] ? peers.CpuCoresAtRest : null,
            stamp is not SimTime lift || WasAtRest(peers, lift),
            Trace(peers, first, end, stamp, dealt));

        PhaseErrors Errors(IReadOnlyList<PeerSamples> samples) =>
            PeerComparison.Errors(samples, peers.Grid, peers.Bodies.Length, first, end, stamp, dealt);
    }

    /// <summary>
    /// Returns the index of the first instant that the lift may have changed. The case before it ends there, and the lift's own begins.
    /// </summary>
    private static int BeforeLift(PeerGroup peers, DropOptions options, in ExternalEvent lifted) =>
        Math.Min(peers.Grid.FirstAfter(peers.Start + options.Window(DropCase.SameStart).Last), peers.Grid.FirstAfter(lifted.Time - SimDuration.OneTick));

    private static bool WasAtRest(PeerGroup peers, SimTime lift)
    {
        peers.Session(0).World!.Simulation.TryRead(BodyId.OfScene(0), lift - SimDuration.OneTick, out BodyState before);
        return before.Motion == MotionLaw.Resting;
    }

    /// <summary>Returns when the last peer showed the event, by its own shared clock. A peer that never received it is ignored.</summary>
    private static SimTime LastDealt(PeerGroup peers, SimTime stamp) => Enumerable.Range(0, peers.PeerCount)
        .Select(p => peers.Session(p).Counters.LastShown).Append(stamp + peers.DisplayDelay).Max();

    private static DropTrace Trace(PeerGroup peers, int first, int end, SimTime? stamp, SimTime dealt)
    {
        int count = end - first;
        int[] instants = Enumerable.Range(first, count).ToArray();
        return new DropTrace(
            Array.ConvertAll(instants, n => (peers.Grid.At(n) - peers.Start).ToSeconds()),
            Heights(peers.Seen),
            Heights(peers.Settled),
            Distances(peers.Seen),
            Distances(peers.SeenTrueTime),
            Distances(peers.Settled),
            GroupFigures.HostEvents(peers, first, end).Where(e => e.Key.Kind == EventKind.Impact).Select(e => (e.Key.Time - peers.Start).ToSeconds()).ToArray(),
            stamp is SimTime lift ? (lift - peers.Start).ToSeconds() : null,
            stamp is null ? null : (dealt - peers.Start).ToSeconds());

        double[][] Heights(IReadOnlyList<PeerSamples> samples) => samples
            .Select(peer => Array.ConvertAll(instants, n => peer.IsShown(n) ? peer.State(n, 0).Position.Y : double.NaN))
            .ToArray();

        double[] Distances(IReadOnlyList<PeerSamples> samples) =>
            Array.ConvertAll(instants, n => PeerComparison.Distance(samples, peers.Bodies.Length, n, out _));
    }
}
