namespace LagSim.Scenes;

/// <summary>A body that a scene has from the start.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct SceneBody
{
    internal SceneBody(string name, BodySpec spec, Vector3D position, Vector3D velocity, PeerSet players, Vector3D spin)
    {
        Name = name;
        Spec = spec;
        Position = position;
        Velocity = velocity;
        Players = players;
        Spin = spin;
    }

    /// <summary>The same place, name and rights with another law of flight.</summary>
    internal SceneBody With(MotionLaw flight) => Spec.Flight == flight ? this : new(Name, Spec.With(flight), Position, Velocity, Players, Spin);

    /// <summary>The name of the body in the scene.</summary>
    public string Name { get; }

    /// <summary>Size, mass, material and flight.</summary>
    public BodySpec Spec { get; }

    /// <summary>Where its centre starts, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>Its velocity at the start, in metres per second.</summary>
    public Vector3D Velocity { get; }

    /// <summary>How it turns at the start, in radians per second about the vector.</summary>
    public Vector3D Spin { get; }

    /// <summary>Which peers may do something to it, in a session.</summary>
    public PeerSet Players { get; }
}
