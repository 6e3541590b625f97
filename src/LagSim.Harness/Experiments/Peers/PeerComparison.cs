using System;
using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>How far apart peers were: at each instant the largest distance of any body between the host and any other peer.</summary>
public static class PeerComparison
{
    /// <summary>The distance in metres at the n-th instant; NaN if a peer stalled.</summary>
    public static double Distance(IReadOnlyList<PeerSamples> peers, int bodies, int n, out bool differs)
    {
        ArgumentNullException.ThrowIfNull(peers);
        differs = false;
        double most = 0;
        foreach (PeerSamples peer in peers)
        {
            if (!peer.IsShown(n))
            {
                return double.NaN;
            }

            for (int body = 0; body < bodies; body++)
            {
                BodyState here = peers[0].State(n, body);
                BodyState there = peer.State(n, body);
                differs |= !here.IsSameBits(there);

                // What one of them has and the other has not is no distance apart, it differs.
                bool areThere = here.Motion != MotionLaw.Absent && there.Motion != MotionLaw.Absent;
                most = areThere ? Math.Max(most, (here.Position - there.Position).Length) : most;
            }
        }

        return most;
    }

    /// <summary>
    /// The first instant at which a body is not the same to the bit as the first of the peers has it, and the first such body and peer;
    /// null if there is none.
    /// </summary>
    /// <param name="peers">One entry a peer; all are compared with the first.</param>
    /// <param name="bodies">How many bodies there are.</param>
    /// <param name="count">How many instants there are.</param>
    public static (int Instant, int Peer, int Body)? FirstDifference(IReadOnlyList<PeerSamples> peers, int bodies, int count)
    {
        ArgumentNullException.ThrowIfNull(peers);
        for (int n = 0; n < count; n++)
        {
            for (int body = 0; body < bodies; body++)
            {
                for (int peer = 1; peer < peers.Count; peer++)
                {
                    if (peers[0].IsShown(n) && peers[peer].IsShown(n) && !peers[0].State(n, body).IsSameBits(peers[peer].State(n, body)))
                    {
                        return (n, peer, body);
                    }
                }
            }
        }

        return null;
    }

    /// <summary>The errors of the instants from <paramref name="first"/> to before <paramref name="end"/>, by phase.</summary>
    /// <param name="peers">One entry a peer, the host first.</param>
    /// <param name="grid">The instants.</param>
    /// <param name="bodies">How many bodies there are.</param>
    /// <param name="first">The number of the first instant.</param>
    /// <param name="end">The number after the last.</param>
    /// <param name="stamp">When the event happened; null: none, and all is before it.</param>
    /// <param name="dealt">When the last peer had dealt with it.</param>
    public static PhaseErrors Errors(
        IReadOnlyList<PeerSamples> peers, SampleGrid grid, int bodies, int first, int end, SimTime? stamp, SimTime dealt) =>
        Errors(peers, bodies, first, end, n => stamp is not SimTime happened || grid.At(n) < happened ? Phase.Before : grid.At(n) < dealt ? Phase.During : Phase.After);

    /// <summary>The same, where the phase of each instant is known.</summary>
    /// <param name="peers">One entry a peer; all are compared with the first.</param>
    /// <param name="bodies">How many bodies there are.</param>
    /// <param name="first">The number of the first instant.</param>
    /// <param name="end">The number after the last.</param>
    /// <param name="phaseOf">The phase of an instant, by its number.</param>
    public static PhaseErrors Errors(IReadOnlyList<PeerSamples> peers, int bodies, int first, int end, Func<int, Phase> phaseOf)
    {
        ArgumentNullException.ThrowIfNull(phaseOf);
        PhaseErrors errors = new();
        for (int n = first; n < end; n++)
        {
            Phase phase = phaseOf(n);
            double distance = Distance(peers, bodies, n, out bool differs);
            if (double.IsNaN(distance))
            {
                errors[phase].AddStalled();
            }
            else
            {
                errors[phase].Add(distance, differs);
            }
        }

        return errors;
    }
}
