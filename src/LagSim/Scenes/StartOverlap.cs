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

        CheckPairs(bodies, box, tolerance);
    }

    // Sort and sweep along the axis on which the bodies are spread most: only bodies whose extents along it overlap are compared.
    private static void CheckPairs(List<SceneBody> bodies, PeriodicBox box, double tolerance)
    {
        int axis = WidestAxis(bodies);
        int images = box.Exists ? 2 : 1; // in a periodic box everybody is there a second time, a side further
        double[] left = new double[bodies.Count * images];
        int[] order = new int[left.Length];
        for (int i = 0; i < order.Length; i++)
        {
            int body = i % bodies.Count;
            left[i] = Along(bodies[body].Position, axis) - bodies[body].Spec.Radius + (i < bodies.Count ? 0 : Along(box.Size, axis));
            order[i] = body;
        }

        Array.Sort(left, order);
        for (int i = 0; i < order.Length; i++)
        {
            SceneBody a = bodies[order[i]];
            double right = left[i] + (2 * a.Spec.Radius);
            for (int j = i + 1; j < order.Length && left[j] <= right; j++)
            {
                SceneBody b = bodies[order[j]];
                double gap = box.Nearest(a.Position - b.Position).Length - a.Spec.Radius - b.Spec.Radius;
                double slack = tolerance + (1e-15 * (Size(a.Position) + Size(b.Position) + a.Spec.Radius + b.Spec.Radius));
                if (gap < -slack)
                {
                    throw Overlap(a.Name, SceneBuilder.Whose(b), -gap);
                }
            }
        }
    }

    private static int WidestAxis(List<SceneBody> bodies)
    {
        int widest = 0;
        double most = -1;
        for (int axis = 0; axis < 3; axis++)
        {
            double least = double.MaxValue;
            double greatest = double.MinValue;
            foreach (SceneBody body in bodies)
            {
                double at = Along(body.Position, axis);
                least = Math.Min(least, at);
                greatest = Math.Max(greatest, at);
            }

            if (greatest - least > most)
            {
                widest = axis;
                most = greatest - least;
            }
        }

        return widest;
    }

    private static double Along(in Vector3D v, int axis) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;

    private static double Size(in Vector3D v) => Math.Abs(v.X) + Math.Abs(v.Y) + Math.Abs(v.Z);

    private static SceneException Overlap(string body, string other, double depth) =>
        new($"Body '{body}' starts {Limits.Text(depth)} m deep inside {other}; bodies must start apart or touching.");
}
