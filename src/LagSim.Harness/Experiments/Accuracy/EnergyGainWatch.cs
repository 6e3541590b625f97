using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// Measures how much energy comes from nothing: the largest rise of kinetic, rotational and potential energy over the least before.
/// </summary>
/// <remarks>
/// The energy that friction and impacts take is right and is not counted. The gain is relative to the energy at the start, with heights
/// counted from the origin, where the floors of these scenes are.
/// </remarks>
internal sealed class EnergyGainWatch(Scene scene)
{
    private double start = double.NaN;
    private double least;

    /// <summary>The largest gain so far, relative to the energy at the start; NaN once a state is not finite.</summary>
    internal double Worst { get; private set; }

    internal void Look(IWorkRun run)
    {
        double energy = 0;
        for (int n = 0; n < scene.Bodies.Count; n++)
        {
            BodySpec spec = scene.Bodies[n].Spec;
            double turning = 0.2 * spec.Radius * spec.Radius * run.Spin(n).LengthSquared; // 2/5 m r^2
            energy += spec.Mass * (turning + (0.5 * run.Velocity(n).LengthSquared) - Vector3D.Dot(scene.Gravity, run.Position(n)));
        }

        if (double.IsNaN(start))
        {
            start = least = energy;
        }

        Worst = double.IsFinite(energy) ? Math.Max(Worst, (energy - least) / start) : double.NaN;
        least = Math.Min(least, energy);
    }
}
