using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>How to draw a body in a frame.</summary>
/// <remarks>
/// Immutable, safe on any thread. <see cref="Jump"/>, <see cref="Decay"/> and <see cref="Dropped"/> refer to this frame alone.
/// </remarks>
public readonly struct DrawnBody
{
    internal DrawnBody(in BodyState state, in Vector3D offset, double jump, double decay, double dropped)
    {
        State = state;
        Offset = offset;
        Jump = jump;
        Decay = decay;
        Dropped = dropped;
        Position = state.Position + offset;
    }

    /// <summary>A body in this player's own hand, drawn exactly where the hand has it.</summary>
    internal DrawnBody(in BodyState state, in Vector3D position)
    {
        State = state;
        Offset = position - state.Position;
        Position = position;
        IsInHand = true;
        Jump = 0;
        Decay = 0;
        Dropped = 0;
    }

    /// <summary>The body's actual state, as far as this peer knows.</summary>
    public BodyState State { get; }

    /// <summary>How far from its actual position it is drawn, in metres.</summary>
    public Vector3D Offset { get; }

    /// <summary>Where to draw its centre, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>Whether it is in this player's own hand, and drawn where the hand has it; see <see cref="DisplayOffsets.SetHand"/>.</summary>
    public bool IsInHand { get; }

    /// <summary>
    /// How far late events have moved what the previous frame showed, in metres: the jump that would be visible without an offset.
    /// </summary>
    public double Jump { get; }

    /// <summary>How much the offset has shrunk with time, in metres.</summary>
    public double Decay { get; }

    /// <summary>
    /// How much offset was dropped at once, in metres: drawn inside something, hidden in a bounce, too large to be smoothed, or the body
    /// moved elsewhere.
    /// </summary>
    public double Dropped { get; }
}
