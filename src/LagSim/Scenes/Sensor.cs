using System;

namespace LagSim.Scenes;

/// <summary>A sensor: a region that tells which bodies are inside of it, and touches none. It stands still, or a body carries it.</summary>
/// <remarks>
/// A body is inside where the distance of its centre to the region, grown or shrunk by <see cref="Coverage"/>, is below zero; it enters and
/// leaves where that distance changes its sign, and a touch from one side is no crossing. Only bodies whose collision filter matches its
/// own can be inside. Immutable, safe on any thread. A scene checks it.
/// </remarks>
public readonly struct Sensor : IEquatable<Sensor>
{
    internal Sensor(
        string name, SensorShape shape, in Vector3D vector, double measure, SensorCoverage coverage, CollisionFilter filter = default,
        BodyId? carrier = null)
    {
        Name = name;
        Shape = shape;
        Vector = vector;
        Measure = measure;
        Coverage = coverage;
        Filter = filter;
        Carrier = carrier;
    }

    /// <summary>The name of the sensor in a scene.</summary>
    public string Name { get; }

    /// <summary>Its shape.</summary>
    public SensorShape Shape { get; }

    /// <summary>How much of a body has to be in the region.</summary>
    public SensorCoverage Coverage { get; }

    /// <summary>Which bodies it sees: those that would collide with this filter; default all.</summary>
    public CollisionFilter Filter { get; }

    /// <summary>The body that carries it, and that it does not see; null for a sensor that stands still.</summary>
    public BodyId? Carrier { get; }

    /// <summary>Of a plane the unit normal, away from the region; zero for a sphere.</summary>
    public Vector3D Normal => Shape == SensorShape.Plane ? Vector : Vector3D.Zero;

    /// <summary>Of a plane its signed distance from the origin along the normal, in metres; zero for a sphere.</summary>
    public double Offset => Shape == SensorShape.Plane ? Measure : 0;

    /// <summary>Of a sphere the centre, in metres, from that of the carrier if it has one; zero for a plane.</summary>
    public Vector3D Centre => Shape == SensorShape.Sphere ? Vector : Vector3D.Zero;

    /// <summary>Of a sphere the radius, in metres; zero for a plane.</summary>
    public double Radius => Shape == SensorShape.Sphere ? Measure : 0;

    internal Vector3D Vector { get; }

    internal double Measure { get; }

    /// <summary>The plane of the boundary, with the region behind it.</summary>
    internal StaticPlane Front => new(Name, Vector, Measure, 1, 0);

    /// <summary>The plane of the boundary, with the region in front of it.</summary>
    internal StaticPlane Behind => new(Name, -Vector, -Measure, 1, 0);

    /// <summary>The size of the numbers that its place is told by, in metres: a bound for rounding.</summary>
    internal double Size => Shape == SensorShape.Plane
        ? Math.Abs(Measure)
        : Math.Abs(Vector.X) + Math.Abs(Vector.Y) + Math.Abs(Vector.Z) + Measure;

    /// <summary>Whether every part but the name is the same.</summary>
    internal bool IsSameRegionAs(in Sensor other) =>
        (Shape, Coverage, Measure, Filter, Carrier) == (other.Shape, other.Coverage, other.Measure, other.Filter, other.Carrier)
        && Vector == other.Vector;

    /// <summary>The same sensor, which sees others.</summary>
    internal Sensor With(CollisionFilter filter) => new(Name, Shape, Vector, Measure, Coverage, filter, Carrier);

    /// <summary>The same sensor, carried by a body.</summary>
    internal Sensor CarriedBy(BodyId body) => new(Name, Shape, Vector, Measure, Coverage, Filter, body);

    /// <summary>By how much the region counts as larger, for a body of that radius, in metres.</summary>
    internal double Growth(double radius) => Coverage == SensorCoverage.Centre ? 0 : Coverage == SensorCoverage.Part ? radius : -radius;

    /// <summary>How far a body is from being inside, in metres: negative where it is.</summary>
    /// <param name="centre">Where the body's centre is, in metres, from that of the carrier if the sensor has one.</param>
    /// <param name="radius">Its radius, in metres.</param>
    public double Gap(in Vector3D centre, double radius) => Shape == SensorShape.Plane
        ? Vector3D.Dot(Vector, centre) - Measure - Growth(radius)
        : (centre - Vector).Length - Measure - Growth(radius);

    /// <inheritdoc/>
    public bool Equals(Sensor other) => string.Equals(Name, other.Name, StringComparison.Ordinal) && IsSameRegionAs(other);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Sensor other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Measure.GetHashCode() ^ (int)Shape ^ ((int)Coverage << 8);

    /// <summary>The same sensor.</summary>
    public static bool operator ==(in Sensor a, in Sensor b) => a.Equals(b);

    /// <summary>Another sensor.</summary>
    public static bool operator !=(in Sensor a, in Sensor b) => !a.Equals(b);
}
