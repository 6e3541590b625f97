using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>Measures the energy of a run's bodies against that at the start.</summary>
internal sealed class EnergyWatch(Scene scene)
{
    private double start = double.NaN;

    /// <summary>The largest relative error so far; NaN once a state is not finite.</summary>
    internal double Worst { get; private set; }

    internal void Look(IWorkRun run)
    {
        double energy = 0;
        for (int n = 0; n < scene.Bodies.Count; n++)
        {
            energy += scene.Bodies[n].Spec.Mass * ((0.5 * run.Velocity(n).LengthSquared) - Vector3D.Dot(scene.Gravity, run.Position(n)));
        }

        start = double.IsNaN(start) ? energy : start;
        Worst = double.IsFinite(energy) ? Math.Max(Worst, Math.Abs((energy / start) - 1)) : double.NaN;
    }
}
