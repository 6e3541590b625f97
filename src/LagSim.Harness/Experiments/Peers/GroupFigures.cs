using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>What every report of a group of peers has, read off once the run has ended, but for the traffic.</summary>
internal static class GroupFigures
{
    /// <summary>What each peer has sent and received so far.</summary>
    internal static PortTraffic[] Traffic(PeerGroup peers) => All(peers, peers.Traffic);

    /// <summary>What each peer has sent a second, between two looks at the traffic.</summary>
    internal static double[] BytesPerSecond(PortTraffic[] before, PortTraffic[] after, double seconds) =>
        before.Zip(after, (a, b) => (b.BytesSent - a.BytesSent) / seconds).ToArray();

    /// <summary>By how many milliseconds other peers' events came after their stamp.</summary>
    internal static IEnumerable<double> Latenesses(PeerGroup peers) =>
        All(peers, p => peers.Session(p).Counters.Lateness).SelectMany(late => late).Select(late => late.ToMilliseconds());

    /// <summary>How often peers rewrote their timelines for another's event that came late.</summary>
    internal static long Heals(PeerGroup peers) => All(peers, p => peers.Session(p).Counters.Heals).Sum();

    /// <summary>Each peer's state at the n-th instant.</summary>
    internal static ulong[] StateHashes(PeerGroup peers, int n) => All(peers, p => peers.Session(p).World!.Simulation.StateHash(peers.Grid.At(n)));

    /// <summary>Each peer's hash of all events up to the n-th instant.</summary>
    internal static ulong[] EventHashes(PeerGroup peers, int n) => All(peers, p => peers.Session(p).World!.Simulation.EventHash(peers.Grid.At(n)));

    /// <summary>What happened in the host's world between two instants, body by body.</summary>
    internal static IEnumerable<TimelineEntry> HostEvents(PeerGroup peers, int first, int end)
    {
        SimTime from = peers.Grid.At(first) - PeerGroupOptions.SampleInterval;
        SimTime to = peers.Grid.At(end - 1);
        return peers.Bodies
            .SelectMany(body => peers.Session(0).World!.Simulation.Timeline(body))
            .Where(entry => entry.Key.Time > from && entry.Key.Time <= to);
    }

    /// <summary>The world that had everything on time: what the host accepted, at its own time, before anything was simulated.</summary>
    internal static Simulation Truth(PeerGroup peers, IReadOnlyList<ExternalEvent> accepted, CancellationToken cancellation)
    {
        Simulation truth = new(peers.Scene, new SimulationOptions(peers.Start, SimDuration.MaxValue, cancellation: cancellation));
        foreach (ExternalEvent external in accepted)
        {
            truth.Submit(external);
        }

        truth.AdvanceTo(peers.Grid.At(peers.Grid.Count - 1));
        return truth;
    }

    private static T[] All<T>(PeerGroup peers, Func<int, T> figure) => Enumerable.Range(0, peers.PeerCount).Select(figure).ToArray();
}
