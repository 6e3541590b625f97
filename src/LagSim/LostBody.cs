using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <summary>A body that has left the world because its motion cannot be followed further, and from where.</summary>
/// <remarks>Immutable, safe on any thread. A late event may bring the body back, as it may change everything in the window.</remarks>
public readonly struct LostBody
{
    internal LostBody(BodyId body, SimTime time, LossReason reason, in Vector3D position, in Vector3D velocity, string text)
    {
        Body = body;
        Time = time;
        Reason = reason;
        Position = position;
        Velocity = velocity;
        this.text = text;
    }

    private readonly string? text;

    /// <summary>Which body.</summary>
    public BodyId Body { get; }

    /// <summary>When it left.</summary>
    public SimTime Time { get; }

    /// <summary>Why.</summary>
    public LossReason Reason { get; }

    /// <summary>Where it was then, in m; zero if that is not a number.</summary>
    public Vector3D Position { get; }

    /// <summary>The velocity with which it could be followed no further, in m/s; zero if that is not a number.</summary>
    public Vector3D Velocity { get; }

    /// <summary>All of it as a sentence, with the body's name and the forces that acted on it.</summary>
    public override string ToString() => text ?? "";
}
