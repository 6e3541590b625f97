using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Refuses a scene whose bodies start inside one another, a plane or a static sphere.</summary>
internal static class StartOverlap
{
    internal static void Check(List<SceneBody> bodies, List<StaticPlane> planes, List<StaticSphere> spheres, PeriodicBox box, double tolerance)
    {
        foreach (SceneBody body in bodies)
        {
            // Rounding of the given numbers themselves must not count as an overlap.
            double slack = tolerance + (1e-15 * (Size(body.Position) + body.Spec.Radius));
            foreach (StaticPlane plane in planes)
            {
                double gap = plane.Gap(body.Position, body.Spec.Radius);
                if (gap < -slack)
                {
                    throw Overlap(body.Name, $"plane '{plane.Name}'", -gap);
                }
            }

            foreach (StaticSphere sphere in spheres)
            {
                double gap = (body.Position - sphere.Centre).Length - sphere.Radius - body.Spec.Radius;
                if (gap < -slack)
                {
                    throw Overlap(body.Name, $"static sphere '{sphere.Name}'", -gap);
                }
            }
        }

        if (new OverlapSearch(bodies, box, tolerance).TryFind(out int first, out int second, out double depth))
        {
            throw Overlap(bodies[first].Name, SceneBuilder.Whose(bodies[second]), depth);
        }
    }

    private static double Size(in Vector3D v) => Math.Abs(v.X) + Math.Abs(v.Y) + Math.Abs(v.Z);

    private static SceneException Overlap(string body, string other, double depth) =>
        new($"Body '{body}' starts {Limits.Text(depth)} m deep inside {other}; bodies must start apart or touching.");
}
