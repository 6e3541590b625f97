using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>How far balls get from where they were at some time, by which they should lie still.</summary>
/// <param name="scene">The scene.</param>
/// <param name="from">That time, in seconds.</param>
internal sealed class DriftWatch(Scene scene, double from)
{
    /// <summary>What a sum of steps may be short of a time.</summary>
    private const double Hair = 1e-9;

    private Vector3D[]? before;

    /// <summary>The furthest so far in metres; NaN once a place is not finite.</summary>
    internal double Worst { get; private set; }

    internal void Look(IWorkRun run)
    {
        if (run.Seconds < from - Hair)
        {
            return;
        }

        bool isFirst = before is null;
        before ??= new Vector3D[scene.Bodies.Count];
        for (int n = 0; n < before.Length; n++)
        {
            before[n] = isFirst ? run.Position(n) : before[n];
            double moved = (run.Position(n) - before[n]).Length;
            Worst = double.IsFinite(moved) ? Math.Max(Worst, moved) : double.NaN;
        }
    }
}
