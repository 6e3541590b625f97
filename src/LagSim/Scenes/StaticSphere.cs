namespace LagSim.Scenes;

/// <summary>A sphere that never moves.</summary>
/// <remarks>Immutable, safe on any thread. A scene checks it.</remarks>
public readonly struct StaticSphere
{
    internal StaticSphere(string name, Vector3D centre, double radius, double restitution, double friction, CollisionFilter filter = default)
    {
        Name = name;
        Centre = centre;
        Radius = radius;
        Restitution = restitution;
        Friction = friction;
        Filter = filter;
    }

    /// <summary>The name of the sphere in a scene.</summary>
    public string Name { get; }

    /// <summary>The centre, in metres.</summary>
    public Vector3D Centre { get; }

    /// <summary>The radius in metres.</summary>
    public double Radius { get; }

    /// <summary>The coefficient of restitution, 0 to 1; in a contact the lesser of the two sides' values counts.</summary>
    public double Restitution { get; }

    /// <summary>The coefficient of friction, 0 to 100; in a contact the lesser of the two sides' values counts.</summary>
    public double Friction { get; }

    /// <summary>Which bodies collide with it; default all.</summary>
    public CollisionFilter Filter { get; }
}
