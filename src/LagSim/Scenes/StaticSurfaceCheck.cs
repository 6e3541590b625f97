using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Checks the planes and static spheres of a scene.</summary>
internal static class StaticSurfaceCheck
{
    /// <summary>Checks them all.</summary>
    /// <exception cref="SceneException">A value is out of its range; the sentence names it and what is allowed.</exception>
    internal static void Throw(List<StaticPlane> planes, List<StaticSphere> spheres)
    {
        foreach (StaticPlane plane in planes)
        {
            Limits.InRange(plane.Restitution, 0, 1, $"plane '{plane.Name}'", "restitution", "(no unit)");
            Limits.InRange(plane.Friction, 0, Limits.MaxFriction, $"plane '{plane.Name}'", "friction", "(no unit)");
            Limits.InRange(plane.Offset, -Limits.MaxCoordinate, Limits.MaxCoordinate, $"plane '{plane.Name}'", "offset", "m");
        }

        foreach (StaticSphere sphere in spheres)
        {
            Limits.CheckPosition(sphere.Centre, $"static sphere '{sphere.Name}'");
            Limits.InRange(sphere.Radius, Limits.MinRadius, Limits.MaxRadius, $"static sphere '{sphere.Name}'", "radius", "m");
            Limits.InRange(sphere.Restitution, 0, 1, $"static sphere '{sphere.Name}'", "restitution", "(no unit)");
            Limits.InRange(sphere.Friction, 0, Limits.MaxFriction, $"static sphere '{sphere.Name}'", "friction", "(no unit)");
        }
    }
}
