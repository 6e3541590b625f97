using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

public abstract partial class WorkScene
{
    /// <summary>The furthest that the first body is from where it should be.</summary>
    private protected sealed class PathWatch(Func<double, Vector3D> exact) : IWatch
    {
        private double worst;

        /// <inheritdoc/>
        public void Look(IWorkRun run)
        {
            double off = (run.Position(0) - exact(run.Seconds)).Length;
            worst = double.IsFinite(off) ? Math.Max(worst, off) : double.NaN;
        }

        /// <inheritdoc/>
        public IReadOnlyList<double> Errors(IWorkRun run) => [worst];
    }
}
