using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>Two that meet in an impact, as they are right before it.</summary>
internal readonly struct ImpactContact
{
    /// <summary>The surface of a contact between two bodies.</summary>
    internal const int NoSurface = -1;

    internal ImpactContact(BodyId first, BodyId second, int surface, in Vector3D position, double closingSpeed)
    {
        First = first;
        Second = second;
        Surface = surface;
        Position = position;
        ClosingSpeed = closingSpeed;
    }

    /// <summary>The body, of two the one of lesser identity.</summary>
    internal BodyId First { get; }

    /// <summary>The other body; <see cref="First"/> again where it met a surface.</summary>
    internal BodyId Second { get; }

    /// <summary>Planes by index, static spheres after them, or <see cref="NoSurface"/>.</summary>
    internal int Surface { get; }

    /// <summary>Where they touch, in metres: on the surface of <see cref="First"/>.</summary>
    internal Vector3D Position { get; }

    /// <summary>How fast they approach along their normal, in m/s.</summary>
    internal double ClosingSpeed { get; }
}
