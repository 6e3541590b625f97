using System;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines.Packages;

/// <summary>A surface as a large box behind it, for engines that have no planes; its sides are along the axes.</summary>
internal static class BoxWall
{
    /// <summary>Why an engine whose walls are such boxes is left out of a scene; null if it is not.</summary>
    internal static string? Excludes(Scene scene) => scene.StaticSpheres.Count > 0 ? "its static spheres are not set up here"
        : scene.Planes.All(plane => IsOne(plane.Normal.X) || IsOne(plane.Normal.Y) || IsOne(plane.Normal.Z)) ? null
        : "its walls are boxes along the axes, and the scene has one that is oblique";

    /// <summary>
    /// The box's centre and its sides in metres: thick enough that nothing gets through it in a step, and no larger than single precision
    /// bears.
    /// </summary>
    internal static (Vector3D Centre, Vector3D Sides) Of(StaticPlane plane)
    {
        const double thick = 10, wide = 400;
        return (plane.Normal * (plane.Offset - (thick / 2)), new Vector3D(Side(plane.Normal.X), Side(plane.Normal.Y), Side(plane.Normal.Z)));

        static double Side(double component) => IsOne(component) ? thick : wide;
    }

    private static bool IsOne(double component) => Math.Abs(component) == 1;
}
