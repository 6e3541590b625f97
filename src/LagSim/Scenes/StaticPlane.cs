namespace LagSim.Scenes;

/// <summary>A plane that never moves: the points p with Normal . p = Offset; bodies live on the side the normal points to.</summary>
/// <remarks>Immutable, safe on any thread. A scene checks and normalises it.</remarks>
public readonly struct StaticPlane
{
    internal StaticPlane(string name, Vector3D normal, double offset, double restitution, double friction, CollisionFilter filter = default)
    {
        Name = name;
        Normal = normal;
        Offset = offset;
        Restitution = restitution;
        Friction = friction;
        Filter = filter;
    }

    /// <summary>The name of the plane in a scene.</summary>
    public string Name { get; }

    /// <summary>The unit normal, towards the side where bodies are.</summary>
    public Vector3D Normal { get; }

    /// <summary>The signed distance of the plane from the origin along the normal, in metres.</summary>
    public double Offset { get; }

    /// <summary>The coefficient of restitution, 0 to 1; in a contact the lesser of the two sides' values counts.</summary>
    public double Restitution { get; }

    /// <summary>The coefficient of friction, 0 to 100; in a contact the lesser of the two sides' values counts.</summary>
    public double Friction { get; }

    /// <summary>Which bodies collide with it; default all.</summary>
    public CollisionFilter Filter { get; }

    /// <summary>The distance in metres between the plane and a sphere; negative where they overlap.</summary>
    public double Gap(in Vector3D centre, double radius) => Vector3D.Dot(Normal, centre) - Offset - radius;
}
