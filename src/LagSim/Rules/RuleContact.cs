using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>An impact of two, or of a body and a surface, as rules hear of it.</summary>
/// <remarks>Immutable. The same bits on every peer.</remarks>
public readonly struct RuleContact
{
    internal RuleContact(in ImpactContact contact)
    {
        First = contact.First;
        Second = contact.Second;
        Surface = contact.Surface;
        Position = contact.Position;
        ClosingSpeed = contact.ClosingSpeed;
    }

    /// <summary>The body, of two the one of lesser identity.</summary>
    public BodyId First { get; }

    /// <summary>The other body; <see cref="First"/> again where it met a surface.</summary>
    public BodyId Second { get; }

    /// <summary>The surface that it met: planes by index, static spheres after them, or -1 where two bodies met.</summary>
    public int Surface { get; }

    /// <summary>Where they touch, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>How fast they approached along their normal right before, in m/s, above zero.</summary>
    public double ClosingSpeed { get; }
}
