using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Reports;

namespace LagSim.Harness.Accuracy;

/// <summary>Who is in front at which error, in computed sentences.</summary>
public static class WorkFindings
{
    /// <summary>What stands beside any figures of speed against physics engines.</summary>
    public const string Caution =
        "Sparse frictionless scenes favour an event-driven engine; stacks, friction and joints do not: there the engines compared here are at home, and LagSim is not.";

    /// <summary>For each scene and peer: where LagSim is not in front, or by how much it is at least.</summary>
    /// <remarks>
    /// LagSim's cost at an error is read from its curves: between two neighbouring settings of a method on the line that joins them in the diagram, at errors
    /// above a setting's that setting's own. Only the kind of error that diagrams show counts.
    /// </remarks>
    public static IReadOnlyList<string> Sentences(IReadOnlyList<WorkPoint> points)
    {
        ArgumentNullException.ThrowIfNull(points);
        List<string> sentences = [];
        foreach (IGrouping<string, WorkPoint> scene in points.GroupBy(point => point.Scene))
        {
            string kind = scene.First().ErrorKind;
            WorkPoint[] shown = [.. scene.Where(point => point.ErrorKind == kind)], own = [.. shown.Where(IsOwn)];
            foreach (IGrouping<string, WorkPoint> peer in shown.Where(point => !IsOwn(point)).GroupBy(point => point.Method))
            {
                sentences.AddRange(Against(scene.Key, peer.Key, [.. peer.Where(point => !double.IsNaN(point.Error))], own));
            }
        }

        return sentences;
    }

    /// <summary>Whether a point is LagSim's.</summary>
    internal static bool IsOwn(WorkPoint point) => point.Method.StartsWith("LagSim", StringComparison.Ordinal);

    /// <summary>The least CPU time at which a curve, given from coarse to fine, has that error; infinite where it never does.</summary>
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

    private static IEnumerable<string> Against(string scene, string peer, WorkPoint[] points, WorkPoint[] own)
    {
        double least = double.PositiveInfinity;
        foreach (WorkPoint point in points)
        {
            (double cost, string method) = own.GroupBy(o => o.Method).Select(curve => (Cost([.. curve], point.Error), curve.Key)).Min();
            if (double.IsPositiveInfinity(cost))
            {
                yield return $"{scene}: NOT in front of {peer} at {point.Setting}: no setting of LagSim is as exact as {NumberText.Short(point.Error)} {point.ErrorKind}.";
                least = 0;
                continue;
            }

            double factor = point.CpuSeconds / cost;
            least = Math.Min(least, factor);
            if (factor < 1)
            {
                yield return $"{scene}: NOT in front of {peer} at {point.Setting} (error {NumberText.Short(point.Error)}): {method} takes {NumberText.Short(1 / factor)} times as long for that error or less.";
            }
        }

        if (least >= 1 && points.Length > 0)
        {
            yield return $"{scene}: in front of {peer} at every error, by {NumberText.Short(least)} times at least.";
        }
    }
}
