using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using LagSim.Harness.Experiments.Peers;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>
/// Measures every step that applies late events: its duration, what was re-simulated, and how far bodies jump between the old and the new
/// render snapshot at the same instant. A peer's own events are not late and are left out.
/// </summary>
internal sealed class HealWatch
{
    private readonly VirtualPeers peers;
    private readonly RenderSnapshot?[] shown;
    private readonly List<double> milliseconds = [];
    private readonly List<HealReport> reports = [];
    private readonly List<double> jumps = [];
    private long began;
    private bool isOwn;
    private bool hasHealed;

    /// <summary>Subscribes to a connected group.</summary>
    internal HealWatch(VirtualPeers peers)
    {
        this.peers = peers;
        shown = new RenderSnapshot?[peers.PeerCount];
        for (int peer = 0; peer < peers.PeerCount; peer++)
        {
            peers.Session(peer).World!.Simulation.Healed += OnHealed;
        }

        peers.Steps.BeforeStep = Before;
        peers.Steps.AfterStep = After;
    }

    /// <summary>The figures of each heal.</summary>
    internal IReadOnlyList<HealReport> Reports => reports;

    /// <summary>The wall-clock time of each step in which late events were healed.</summary>
    internal IReadOnlyList<double> Milliseconds => milliseconds;

    /// <summary>The distances of the bodies that jumped, in metres.</summary>
    internal IReadOnlyList<double> Jumps => jumps;

    /// <summary>Performs a player's action. What it rewrites of the predicted near future is not counted.</summary>
    internal T Own<T>(Func<T> action)
    {
        isOwn = true;
        try
        {
            return action();
        }
        finally
        {
            isOwn = false;
        }
    }

    private void OnHealed(HealReport report)
    {
        if (!isOwn)
        {
            hasHealed = true;
            reports.Add(report);
        }
    }

    private void Before(int peer)
    {
        shown[peer] = peers.Session(peer).World!.RenderSnapshots.Latest();
        hasHealed = false;
        began = Stopwatch.GetTimestamp();
    }

    private void After(int peer)
    {
        if (!hasHealed)
        {
            return;
        }

        milliseconds.Add(Stopwatch.GetElapsedTime(began).TotalMilliseconds);
        SimTime time = peers.Session(peer).DisplayTime;
        RenderSnapshot old = shown[peer]!;
        if (!old.Covers(time))
        {
            return;
        }

        // The old render snapshot is valid until the next one is requested.
        BodyState[] before = peers.Bodies.Select(body => Read(old, body, time)).ToArray();
        RenderSnapshot now = peers.Session(peer).World!.RenderSnapshots.Latest();
        for (int n = 0; n < before.Length && now.Covers(time); n++)
        {
            BodyState after = Read(now, peers.Bodies[n], time);
            double jump = (after.Position - before[n].Position).Length;
            if (jump > 0 && before[n].Motion != MotionLaw.Absent && after.Motion != MotionLaw.Absent)
            {
                jumps.Add(jump);
            }
        }
    }

    private static BodyState Read(RenderSnapshot snapshot, BodyId body, SimTime time)
    {
        snapshot.TryRead(body, time, out BodyState state);
        return state;
    }
}
