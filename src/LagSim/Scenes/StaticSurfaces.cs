using System;

namespace LagSim.Scenes;

/// <summary>The static surfaces of a scene by number: the planes in the scene's order, then the static spheres.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
internal readonly struct StaticSurfaces(StaticPlane[] planes, StaticSphere[] spheres)
{
    private readonly StaticPlane[] planes = planes;
    private readonly StaticSphere[] spheres = spheres;

    /// <summary>Whether some surface has another filter than the default.</summary>
    internal bool HaveFilters { get; } = Array.Exists(planes, p => !p.Filter.IsDefault) || Array.Exists(spheres, s => !s.Filter.IsDefault);

    /// <summary>How many there are.</summary>
    internal int Count => planes.Length + spheres.Length;

    /// <summary>How many of them are planes; these come first.</summary>
    internal int Planes => planes.Length;

    /// <summary>Whether a surface is a plane; otherwise it is a sphere.</summary>
    internal bool IsPlane(int surface) => surface < planes.Length;

    internal ref readonly StaticPlane Plane(int surface) => ref planes[surface];

    internal ref readonly StaticSphere Sphere(int surface) => ref spheres[surface - planes.Length];

    /// <summary>The distance in metres between a surface and a ball; negative where they overlap.</summary>
    internal double Gap(int surface, in Vector3D centre, double radius)
    {
        if (surface < planes.Length)
        {
            return planes[surface].Gap(centre, radius);
        }

        ref readonly StaticSphere sphere = ref spheres[surface - planes.Length];
        return (centre - sphere.Centre).Length - (radius + sphere.Radius);
    }

    /// <summary>The unit normal of a surface towards a point.</summary>
    internal Vector3D Normal(int surface, in Vector3D point) =>
        surface < planes.Length ? planes[surface].Normal : (point - spheres[surface - planes.Length].Centre).Direction;

    /// <summary>
    /// How far, in metres, the centre of what touches a surface is from the centre of its curvature; infinite for a plane.
    /// </summary>
    internal double Reach(int surface, double radius) =>
        surface < planes.Length ? double.PositiveInfinity : radius + spheres[surface - planes.Length].Radius;

    internal double Restitution(int surface) =>
        surface < planes.Length ? planes[surface].Restitution : spheres[surface - planes.Length].Restitution;

    internal double Friction(int surface) =>
        surface < planes.Length ? planes[surface].Friction : spheres[surface - planes.Length].Friction;

    internal CollisionFilter Filter(int surface) =>
        surface < planes.Length ? planes[surface].Filter : spheres[surface - planes.Length].Filter;

    /// <summary>Whether some surface takes energy: its restitution is below 1.</summary>
    internal bool TakesEnergy()
    {
        bool takes = false;
        for (int i = 0; i < Count && !takes; i++)
        {
            takes = Restitution(i) < 1;
        }

        return takes;
    }
}
