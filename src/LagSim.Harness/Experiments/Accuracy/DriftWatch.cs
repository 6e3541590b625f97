using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>Measures how far balls move after a time by which they should be at rest.</summary>
/// <param name="scene">The scene.</param>
/// <param name="from">The time, in seconds.</param>
internal sealed class DriftWatch(Scene scene, double from)
{
    /// <summary>The most by which a sum of steps may fall short of a time.</summary>
    private const double Hair = 1e-9;

    private Vector3D[]? before;

    /// <summary>The largest distance so far, in metres; NaN once a position is not finite.</summary>
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
