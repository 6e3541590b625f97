using System;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>A surface as a large box behind it, with its sides along the axes, for engines without planes.</summary>
internal static class BoxWall
{
    /// <summary>Returns why an engine with such walls is left out of a scene; null if it is not.</summary>
    internal static string? Excludes(Scene scene) => scene.StaticSpheres.Count > 0 ? "its static spheres are not set up here"
        : scene.Planes.All(plane => IsOne(plane.Normal.X) || IsOne(plane.Normal.Y) || IsOne(plane.Normal.Z)) ? null
        : "its walls are boxes along the axes, and the scene has one that is oblique";

    /// <summary>
    /// Returns the box's centre and sides, in metres: thick enough that nothing tunnels through in a step, and small enough for single
    /// precision.
    /// </summary>
    internal static (Vector3D Centre, Vector3D Sides) Of(StaticPlane plane)
    {
        const double thick = 10, wide = 400;
        return (plane.Normal * (plane.Offset - (thick / 2)), new Vector3D(Side(plane.Normal.X), Side(plane.Normal.Y), Side(plane.Normal.Z)));

        static double Side(double component) => IsOne(component) ? thick : wide;
    }

    private static bool IsOne(double component) => Math.Abs(component) == 1;
}
