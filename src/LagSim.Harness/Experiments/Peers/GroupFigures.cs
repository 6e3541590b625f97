using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The figures in every report of a group of peers, computed once the run has ended, except the traffic.</summary>
internal static class GroupFigures
{
    /// <summary>Returns the traffic of each peer so far.</summary>
    internal static PortTraffic[] Traffic(PeerGroup peers) => All(peers, peers.Traffic);

    /// <summary>Returns the bytes per second sent by each peer between two samples of the traffic.</summary>
    internal static double[] BytesPerSecond(PortTraffic[] before, PortTraffic[] after, double seconds) =>
        before.Zip(after, (a, b) => (b.BytesSent - a.BytesSent) / seconds).ToArray();

    /// <summary>Returns how late other peers' events arrived, in milliseconds after their stamp.</summary>
    internal static IEnumerable<double> Latenesses(PeerGroup peers) =>
        All(peers, p => peers.Session(p).Counters.Lateness).SelectMany(late => late).Select(late => late.ToMilliseconds());

    /// <summary>Returns how often peers rewound for another peer's late event.</summary>
    internal static long Heals(PeerGroup peers) => All(peers, p => peers.Session(p).Counters.Heals).Sum();

    /// <summary>Returns each peer's state at the n-th instant.</summary>
    internal static ulong[] StateHashes(PeerGroup peers, int n) => All(peers, p => peers.Session(p).World!.Simulation.StateHash(peers.Grid.At(n)));

    /// <summary>Returns each peer's hash of all events up to the n-th instant.</summary>
    internal static ulong[] EventHashes(PeerGroup peers, int n) => All(peers, p => peers.Session(p).World!.Simulation.EventHash(peers.Grid.At(n)));

    /// <summary>Returns the events in the host's world between two instants, body by body.</summary>
    internal static IEnumerable<TimelineEntry> HostEvents(PeerGroup peers, int first, int end)
    {
        SimTime from = peers.Grid.At(first) - PeerGroupOptions.SampleInterval;
        SimTime to = peers.Grid.At(end - 1);
        return peers.Bodies
            .SelectMany(body => peers.Session(0).World!.Simulation.Timeline(body))
            .Where(entry => entry.Key.Time > from && entry.Key.Time <= to);
    }

    /// <summary>Simulates the reference, which has every accepted event on time.</summary>
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
