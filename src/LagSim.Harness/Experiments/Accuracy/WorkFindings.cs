using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Reports;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The findings of speed against error, as computed sentences.</summary>
public static class WorkFindings
{
    /// <summary>The caveat beside all figures of speed against physics engines.</summary>
    public const string Caution =
        "Scenes of spheres favour LagSim, sparse ones above all; the engines compared here are made for other shapes, joints and many threads too, and for"
            + " heaps in which bodies may sink into each other by a part of their size.";

    private const double Rounding = 1e-12;

    /// <summary>
    /// The kinds of error of which each scene has a sentence, besides the one in diagrams. An error below <see cref="Rounding"/> counts as
    /// zero there.
    /// </summary>
    private static readonly Dictionary<string, string> Besides = new()
    {
        [ContactWork.Overlap] = "overlap",
        [ContactWork.EnergyGain] = "energy gained",
        [ContactWork.Drift] = "drift at rest",
    };

    /// <summary>
    /// Returns sentences for each scene and peer engine: where LagSim is not faster, or its least advantage. Random heaps share one
    /// sentence.
    /// </summary>
    /// <remarks>
    /// LagSim's cost at an error is read from its curves: between two neighbouring settings of a method on the line that joins them in the
    /// diagram, at errors above a setting's that setting's own. Only the kind of error that diagrams show counts; of dense contact each
    /// other kind has a sentence a scene.
    /// </remarks>
    public static IReadOnlyList<string> Sentences(IReadOnlyList<WorkPoint> points)
    {
        ArgumentNullException.ThrowIfNull(points);
        List<string> sentences = [];
        ILookup<string, WorkPoint> scenes = points.ToLookup(point => point.Scene);
        sentences.AddRange(OfDrawn([.. scenes.Where(scene => RandomHeapWork.IsDrawn(scene.Key))]));
        foreach (IGrouping<string, WorkPoint> scene in scenes.Where(scene => !RandomHeapWork.IsDrawn(scene.Key)))
        {
            if (!scene.Any(IsOwn))
            {
                sentences.Add($"{scene.Key}: NOT in front of anybody: no setting of LagSim was done.");
                continue;
            }

            string kind = scene.First().ErrorKind;
            Duel[] duels = [.. DuelsOf(scene, kind)];
            string[] peers = [.. duels.Select(duel => duel.Peer.Method).Distinct()];
            if (peers.Length > 1)
            {
                sentences.Add(Whole(scene.Key, duels));
            }

            sentences.AddRange(peers.SelectMany(peer => Against(scene.Key, peer, [.. duels.Where(duel => duel.Peer.Method == peer)])));
            sentences.AddRange(OfOtherKinds(scene.Key, kind, scene));
        }

        return sentences;
    }

    /// <summary>Whether a point is LagSim's.</summary>
    internal static bool IsOwn(WorkPoint point) => point.Method.StartsWith("LagSim", StringComparison.Ordinal);

    /// <summary>
    /// Returns the least CPU time at which a curve, given from coarse to fine, has an error; infinity where it never does.
    /// </summary>
    internal static double Cost(WorkPoint[] curve, double error)
    {
        double least = double.PositiveInfinity;
        for (int n = 0; n < curve.Length; n++)
        {
            WorkPoint point = curve[n];
            if (point.Error <= error)
            {
                least = Math.Min(least, point.CpuSeconds);
            }

            if (n > 0 && curve[n - 1].Error > error && point.Error < error && point.Error > 0)
            {
                WorkPoint coarser = curve[n - 1];
                double part = Math.Log(coarser.Error / error) / Math.Log(coarser.Error / point.Error);
                least = Math.Min(least, coarser.CpuSeconds * Math.Pow(point.CpuSeconds / coarser.CpuSeconds, part));
            }
        }

        return least;
    }

    /// <summary>Compares each of a peer's points with finite error with LagSim, by one kind of error.</summary>
    private static IEnumerable<Duel> DuelsOf(IEnumerable<WorkPoint> scene, string kind)
    {
        WorkPoint[] shown = [.. scene.Where(point => point.ErrorKind == kind)], own = [.. shown.Where(IsOwn)];
        return shown.Where(point => !IsOwn(point) && !double.IsNaN(point.Error)).Select(point => Duel.Of(point, own));
    }

    /// <summary>Returns a sentence for each other kind of error of a scene of dense contact.</summary>
    private static IEnumerable<string> OfOtherKinds(string name, string shown, IEnumerable<WorkPoint> scene)
    {
        WorkPoint[] points = [.. scene.Select(point => point with { Error = Math.Max(point.Error, Rounding) })];
        string[] kinds = [.. points.Select(point => point.ErrorKind).Distinct()];
        foreach (string kind in kinds.Where(kind => kind != shown && Besides.ContainsKey(kind)))
        {
            Duel[] duels = [.. DuelsOf(points, kind)];
            if (duels.Length > 0)
            {
                yield return Whole($"{name}, {Besides[kind]}", duels, isNamedBelow: false);
            }
        }
    }

    /// <summary>Returns a sentence for all random heaps together, by the kind of error in diagrams.</summary>
    private static IEnumerable<string> OfDrawn(IGrouping<string, WorkPoint>[] heaps)
    {
        Duel[] duels = [.. heaps.SelectMany(heap => DuelsOf(heap, heap.First().ErrorKind))];
        if (duels.Length > 0)
        {
            yield return Whole($"{NumberText.Count(heaps.Length, "heap")} drawn at random", duels, isNamedBelow: false);
        }
    }

    /// <summary>Returns the scene's sentence: faster than all peers, or at how many points not.</summary>
    private static string Whole(string scene, Duel[] duels, bool isNamedBelow = true)
    {
        Duel[] lost = [.. duels.Where(duel => !duel.IsWon)], won = [.. duels.Where(duel => duel.IsWon)];
        Duel? closest = won.MinBy(duel => duel.Factor);
        string least = closest is null ? "" : $"by {NumberText.Short(closest.Factor)} times at least ({closest.Peer.Method} at {closest.Peer.Setting})";
        return lost.Length == 0 ? $"{scene}: in front of every peer at every error, {least}."
            : $"{scene}: NOT in front at {lost.Length} of {NumberText.Count(duels.Length, "point")} of"
                + $" {NumberText.Count(duels.Select(duel => duel.Peer.Method).Distinct().Count(), "peer")}"
                + $"{(isNamedBelow ? ", named below" : "")}{(won.Length > 0 ? "; in front at all others " + least : "")}.";
    }

    private static IEnumerable<string> Against(string scene, string peer, Duel[] duels)
    {
        foreach (Duel duel in duels.Where(duel => !duel.IsWon))
        {
            WorkPoint point = duel.Peer;
            yield return double.IsPositiveInfinity(duel.Cost)
                ? $"{scene}: NOT in front of {peer} at {point.Setting}: no setting of LagSim is as exact as {NumberText.Short(point.Error)}"
                    + $" {WorkErrorKinds.Of(point.ErrorKind).Unit}."
                : $"{scene}: NOT in front of {peer} at {point.Setting} (error {NumberText.Short(point.Error)}): {duel.Method} takes"
                    + $" {NumberText.Short(1 / duel.Factor)} times as long for that error or less.";
        }

        if (duels.All(duel => duel.IsWon))
        {
            yield return $"{scene}: in front of {peer} at every error, by {NumberText.Short(duels.Min(duel => duel.Factor))} times at least.";
        }
    }

    /// <summary>A point of a peer, and LagSim's cost of that error or less.</summary>
    private sealed record Duel(WorkPoint Peer, double Cost, string Method)
    {
        internal double Factor => Peer.CpuSeconds / Cost;

        internal bool IsWon => Factor >= 1;

        internal static Duel Of(WorkPoint peer, WorkPoint[] own)
        {
            (double cost, string method) = own.GroupBy(point => point.Method)
                .Select(curve => (WorkFindings.Cost([.. curve], peer.Error), curve.Key))
                .DefaultIfEmpty((double.PositiveInfinity, "LagSim")).Min();
            return new Duel(peer, cost, method);
        }
    }
}
