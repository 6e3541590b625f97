using System;
using System.Globalization;

namespace LagSim.Scenes;

/// <summary>Three double-precision components; y points up.</summary>
/// <remarks>Immutable. Deterministic: scalar <c>+ - * /</c> and square root in a fixed order, nothing else.</remarks>
public readonly struct Vector3D : IEquatable<Vector3D>
{
    /// <summary>A vector of these components.</summary>
    public Vector3D(double x, double y, double z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    /// <summary>The component along x.</summary>
    public double X { get; }

    /// <summary>The component along y, upwards.</summary>
    public double Y { get; }

    /// <summary>The component along z.</summary>
    public double Z { get; }

    /// <summary>All components zero; also <c>default</c>.</summary>
    public static Vector3D Zero => default;

    /// <summary>Straight up: (0, 1, 0).</summary>
    public static Vector3D Up => new(0, 1, 0);

    /// <summary>True when no component is NaN or infinite.</summary>
    public bool IsFinite => double.IsFinite(X) && double.IsFinite(Y) && double.IsFinite(Z);

    /// <summary>The scalar product.</summary>
    public static double Dot(in Vector3D a, in Vector3D b) => (a.X * b.X) + (a.Y * b.Y) + (a.Z * b.Z);

    /// <summary>The vector product.</summary>
    public static Vector3D Cross(in Vector3D a, in Vector3D b) =>
        new((a.Y * b.Z) - (a.Z * b.Y), (a.Z * b.X) - (a.X * b.Z), (a.X * b.Y) - (a.Y * b.X));

    /// <summary>The taxicab norm, the sum of the components' sizes: no less than the length, and what rounding is in proportion to.</summary>
    internal double Taxicab => Math.Abs(X) + Math.Abs(Y) + Math.Abs(Z);

    /// <summary>The square of the length.</summary>
    public double LengthSquared => Dot(this, this);

    /// <summary>The length.</summary>
    public double Length => Math.Sqrt(Dot(this, this));

    /// <summary>
    /// The unit vector along this one. Of the zero vector it is up: any direction would do, and it is the same everywhere.
    /// </summary>
    internal Vector3D Direction
    {
        get
        {
            double length = Length;
            return length > 0 ? this / length : Up;
        }
    }

    /// <summary>The sum.</summary>
    public static Vector3D operator +(in Vector3D a, in Vector3D b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    /// <summary>The difference.</summary>
    public static Vector3D operator -(in Vector3D a, in Vector3D b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    /// <summary>The opposite.</summary>
    public static Vector3D operator -(in Vector3D a) => new(-a.X, -a.Y, -a.Z);

    /// <summary>The multiple.</summary>
    public static Vector3D operator *(in Vector3D a, double s) => new(a.X * s, a.Y * s, a.Z * s);

    /// <summary>The multiple.</summary>
    public static Vector3D operator *(double s, in Vector3D a) => new(a.X * s, a.Y * s, a.Z * s);

    /// <summary>The quotient, each component divided.</summary>
    public static Vector3D operator /(in Vector3D a, double s) => new(a.X / s, a.Y / s, a.Z / s);

    /// <summary>Equal components; 0 equals -0, NaN equals nothing.</summary>
    public static bool operator ==(in Vector3D a, in Vector3D b) => a.X == b.X && a.Y == b.Y && a.Z == b.Z;

    /// <summary>Some component differs.</summary>
    public static bool operator !=(in Vector3D a, in Vector3D b) => !(a == b);

    /// <summary>The same vector with every -0.0 turned into 0.0, so that equal vectors have equal bits.</summary>
    public Vector3D WithoutNegativeZero() => new(X + 0.0, Y + 0.0, Z + 0.0);

    /// <inheritdoc/>
    public bool Equals(Vector3D other) => X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Vector3D other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => X.GetHashCode() ^ (Y.GetHashCode() * 397) ^ (Z.GetHashCode() * 7919);

    /// <summary>The components with 17 digits, as <c>(x, y, z)</c>.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "({0:R}, {1:R}, {2:R})", X, Y, Z);
}
