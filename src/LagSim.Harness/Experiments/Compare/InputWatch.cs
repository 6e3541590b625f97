using System;
using System.Collections.Generic;
using LagSim.Harness.Experiments.Peers;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>
/// Measures the latency of a player's own input: compares what the render snapshot was going to show of the body with what it showed after
/// the action.
/// </summary>
internal sealed class InputWatch(PeerGroup peers)
{
    private readonly List<(int Peer, int Body, int First, BodyState[] Expected, SimTime Stamp)> actions = [];

    /// <summary>Records what the peer is going to show of the body if nothing happens, as far as its render snapshot reaches.</summary>
    /// <returns>A callback for the stamp of the action.</returns>
    internal Action<SimTime> Expect(int peer, BodyId body)
    {
        PeerSamples seen = peers.Seen[peer];
        RenderSnapshot snapshot = peers.Session(peer).World!.RenderSnapshots.Latest();
        SimDuration ahead = peers.DisplayDelay + LatencyCompensationWindow.DefaultLookAhead; // a world at rest is known for ever; no more is needed
        SimTime last = peers.Session(peer).SharedTime.Now + ahead;
        List<BodyState> expected = [];
        for (int n = seen.Next; n < peers.Grid.Count && peers.Grid.At(n) <= last && snapshot.Covers(seen.ShownAt(peers.Grid.At(n))); n++)
        {
            snapshot.TryRead(body, seen.ShownAt(peers.Grid.At(n)), out BodyState state);
            expected.Add(state);
        }

        int first = seen.Next;
        return stamp => actions.Add((peer, Array.IndexOf(peers.Bodies, body), first, expected.ToArray(), stamp));
    }

    /// <summary>
    /// For each action, the milliseconds from its stamp to the first sample that differs from what was expected. An action without a
    /// visible change within the snapshot has none.
    /// </summary>
    internal IEnumerable<double> Milliseconds()
    {
        foreach ((int peer, int body, int first, BodyState[] expected, SimTime stamp) in actions)
        {
            for (int n = 0; n < expected.Length; n++)
            {
                if (peers.Seen[peer].IsShown(first + n) && !peers.Seen[peer].State(first + n, body).IsSameBits(expected[n]))
                {
                    yield return (peers.Grid.At(first + n) - stamp).ToMilliseconds();
                    break;
                }
            }
        }
    }
}
