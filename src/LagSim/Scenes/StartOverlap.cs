using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Refuses a scene in which bodies start inside one another, a plane or a static sphere.</summary>
internal static class StartOverlap
{
    internal static void Check(SceneBody[] bodies, List<StaticPlane> planes, List<StaticSphere> spheres, PeriodicBox box, double tolerance, int threads)
    {
        ParallelPair.InParts(0, bodies.Length, threads, (from, to) =>
        {
            for (int i = from; i < to; i++)
            {
                CheckStatic(bodies[i], planes, spheres, tolerance);
            }
        });
        if (new OverlapSearch(bodies, box, tolerance).Find(threads) is Overlap found)
        {
            throw Inside(bodies[found.First].Name, SceneBuilder.Whose(bodies[found.Second]), found.Depth);
        }
    }

    private static void CheckStatic(in SceneBody body, List<StaticPlane> planes, List<StaticSphere> spheres, double tolerance)
    {
        // Rounding of the given numbers themselves must not count as an overlap.
        double slack = tolerance + (1e-15 * (body.Position.Taxicab + body.Spec.Radius));
        foreach (StaticPlane plane in planes)
        {
            double gap = plane.Gap(body.Position, body.Spec.Radius);
            if (gap < -slack && body.Spec.Filter.CollidesWith(plane.Filter))
            {
                throw Inside(body.Name, $"plane '{plane.Name}'", -gap);
            }
        }

        foreach (StaticSphere sphere in spheres)
        {
            double gap = (body.Position - sphere.Centre).Length - sphere.Radius - body.Spec.Radius;
            if (gap < -slack && body.Spec.Filter.CollidesWith(sphere.Filter))
            {
                throw Inside(body.Name, $"static sphere '{sphere.Name}'", -gap);
            }
        }
    }

    private static SceneException Inside<T>(string body, T other, double depth) =>
        new($"Body '{body}' starts {Limits.Text(depth)} m deep inside {other}; bodies must start apart or touching.");
}
