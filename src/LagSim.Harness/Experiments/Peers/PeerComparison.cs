using System;
using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>A comparison of peers: at each instant, the largest distance of any body between the host and any other peer.</summary>
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

                // A body that only one of them has is no distance; it is a difference.
                bool areThere = here.Motion != MotionLaw.Absent && there.Motion != MotionLaw.Absent;
                most = areThere ? Math.Max(most, (here.Position - there.Position).Length) : most;
            }
        }

        return most;
    }

    /// <summary>
    /// Finds the first instant at which a body differs in any bit from the first peer's, with the first such body and peer; null if there
    /// is none.
    /// </summary>
    /// <param name="peers">One entry for each peer; all are compared with the first.</param>
    /// <param name="bodies">The number of bodies.</param>
    /// <param name="count">The number of instants.</param>
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
    /// <param name="peers">One entry for each peer, the host first.</param>
    /// <param name="grid">The instants.</param>
    /// <param name="bodies">The number of bodies.</param>
    /// <param name="first">The index of the first instant.</param>
    /// <param name="end">The index after the last instant.</param>
    /// <param name="stamp">The time of the event; null for none, with all samples before it.</param>
    /// <param name="dealt">The time at which the last peer had dealt with the event.</param>
    public static PhaseErrors Errors(
        IReadOnlyList<PeerSamples> peers, SampleGrid grid, int bodies, int first, int end, SimTime? stamp, SimTime dealt) =>
        Errors(peers, bodies, first, end, n => stamp is not SimTime happened || grid.At(n) < happened ? Phase.Before : grid.At(n) < dealt ? Phase.During : Phase.After);

    /// <summary>The same, with a known phase for each instant.</summary>
    /// <param name="peers">One entry for each peer; all are compared with the first.</param>
    /// <param name="bodies">The number of bodies.</param>
    /// <param name="first">The index of the first instant.</param>
    /// <param name="end">The index after the last instant.</param>
    /// <param name="phaseOf">Returns the phase of an instant, by its index.</param>
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
