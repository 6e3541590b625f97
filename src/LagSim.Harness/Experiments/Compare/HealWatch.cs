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
/// Looks at every step of every peer that applies late events: how long it took, what was run again, and how far what is drawn jumps, the
/// old render snapshot against the new one at the same instant. What a peer does itself is not late for it and is left out.
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

    /// <summary>Looks at a group that is connected.</summary>
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

    /// <summary>For each heal what it did.</summary>
    internal IReadOnlyList<HealReport> Reports => reports;

    /// <summary>Wall clock of each step in which late events were healed.</summary>
    internal IReadOnlyList<double> Milliseconds => milliseconds;

    /// <summary>How far, in metres, bodies jumped that jumped at all.</summary>
    internal IReadOnlyList<double> Jumps => jumps;

    /// <summary>Lets a peer do something; what that rewrites of the little future that is known already is not counted.</summary>
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

        // The old render snapshot may be read until the next is asked for.
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
