using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>Measures how deep balls overlap each other, planes and static spheres.</summary>
/// <remarks>Balls are sorted by height, so that a tall pile costs little more than its contacts.</remarks>
internal sealed class OverlapWatch
{
    private readonly Scene scene;
    private readonly Vector3D[] places;
    private readonly double[] radii;
    private readonly double[] lowest;
    private readonly int[] byHeight;

    internal OverlapWatch(Scene scene)
    {
        this.scene = scene;
        int count = scene.Bodies.Count;
        (places, radii, lowest, byHeight) = (new Vector3D[count], new double[count], new double[count], new int[count]);
        for (int n = 0; n < count; n++)
        {
            radii[n] = scene.Bodies[n].Spec.Radius;
        }
    }

    /// <summary>The deepest overlap so far, in metres; 0 if nothing touches, NaN once a position is not finite.</summary>
    internal double Worst { get; private set; }

    internal void Look(IWorkRun run)
    {
        for (int n = 0; n < places.Length; n++)
        {
            places[n] = run.Position(n);
            lowest[n] = places[n].Y - radii[n];
            byHeight[n] = n;
            Worst = places[n].IsFinite ? Worst : double.NaN;
            LookAtGeometry(n);
        }

        Array.Sort((double[])lowest.Clone(), byHeight);
        for (int i = 0; i < byHeight.Length; i++)
        {
            int a = byHeight[i];
            for (int j = i + 1; j < byHeight.Length && lowest[byHeight[j]] < places[a].Y + radii[a]; j++)
            {
                int b = byHeight[j];
                See(radii[a] + radii[b] - (places[a] - places[b]).Length);
            }
        }
    }

    private void LookAtGeometry(int body)
    {
        foreach (StaticPlane plane in scene.Planes)
        {
            See(plane.Offset + radii[body] - Vector3D.Dot(plane.Normal, places[body]));
        }

        foreach (StaticSphere sphere in scene.StaticSpheres)
        {
            See(sphere.Radius + radii[body] - (places[body] - sphere.Centre).Length);
        }
    }

    /// <summary>Updates the maximum. Once it is NaN it stays NaN.</summary>
    private void See(double depth) => Worst = depth > Worst ? depth : Worst;
}
