using System;

namespace LagSim.Scenes;

/// <summary>A box without walls: a body that leaves it on one side comes in on the opposite one. <c>default</c> is no box.</summary>
/// <remarks>Immutable. For statistics and measurements of a world that has the same density everywhere and no edge.</remarks>
public readonly struct PeriodicBox : IEquatable<PeriodicBox>
{
    /// <summary>How many of the largest diameters each side has at least, so that no body meets two images of another at once.</summary>
    public const double MinSides = 5;

    /// <summary>The part of the least side that a body flies before its path is opened again.</summary>
    internal const double FlightPart = 0.125;

    /// <summary>The box from the origin to <paramref name="size"/>, in metres.</summary>
    public PeriodicBox(Vector3D size) => Size = size;

    /// <summary>Its sides in metres; zero for none.</summary>
    public Vector3D Size { get; }

    /// <summary>Whether there is one.</summary>
    public bool Exists => Size != Vector3D.Zero;

    internal double MinSide => Math.Min(Size.X, Math.Min(Size.Y, Size.Z));

    /// <summary>Whether a point lies in the box: each coordinate at least 0 and less than the side.</summary>
    public bool Contains(in Vector3D point) =>
        point.X >= 0 && point.X < Size.X && point.Y >= 0 && point.Y < Size.Y && point.Z >= 0 && point.Z < Size.Z;

    /// <summary>The image in the box of a point at most a few sides away.</summary>
    public Vector3D Wrap(in Vector3D point) =>
        Exists ? new Vector3D(Wrap(point.X, Size.X), Wrap(point.Y, Size.Y), Wrap(point.Z, Size.Z)) : point;

    /// <summary>How far apart two points are by the shortest way, given their difference.</summary>
    public Vector3D Nearest(in Vector3D apart) =>
        Exists ? new Vector3D(Nearest(apart.X, Size.X), Nearest(apart.Y, Size.Y), Nearest(apart.Z, Size.Z)) : apart;

    /// <inheritdoc/>
    public bool Equals(PeriodicBox other) => Size.Equals(other.Size);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PeriodicBox other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Size.GetHashCode();

    /// <summary>Same sides.</summary>
    public static bool operator ==(in PeriodicBox a, in PeriodicBox b) => a.Equals(b);

    /// <summary>Different sides.</summary>
    public static bool operator !=(in PeriodicBox a, in PeriodicBox b) => !a.Equals(b);

    private static double Wrap(double at, double side)
    {
        // Paths are opened again long before they are a side away, so that a step or two do.
        while (at < 0)
        {
            at += side;
        }

        while (at >= side)
        {
            at -= side;
        }

        return at + 0.0;
    }

    internal static double Nearest(double apart, double side)
    {
        double half = 0.5 * side;
        while (apart > half)
        {
            apart -= side;
        }

        while (apart < -half)
        {
            apart += side;
        }

        return apart;
    }
}
