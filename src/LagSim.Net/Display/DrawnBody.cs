using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>How a body is to be drawn in a frame.</summary>
/// <remarks>
/// Immutable, safe on any thread. <see cref="Jump"/>, <see cref="Decay"/> and <see cref="Dropped"/> tell of this frame alone.
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
    }

    /// <summary>Where the body really is, by what this peer knows.</summary>
    public BodyState State { get; }

    /// <summary>How far from there it is drawn, in metres.</summary>
    public Vector3D Offset { get; }

    /// <summary>Where to draw its centre, in metres.</summary>
    public Vector3D Position => State.Position + Offset;

    /// <summary>
    ///  By how many metres late events have moved what was shown in the frame before: the size of the correction that the eye would see
    /// without an offset.
    /// </summary>
    public double Jump { get; }

    /// <summary>By how many metres the offset has shrunk with time.</summary>
    public double Decay { get; }

    /// <summary>
    ///  How many metres of offset were given up at once: drawn inside something, hidden in a bounce, too large to be smoothed, or the body
    /// put elsewhere.
    /// </summary>
    public double Dropped { get; }
}
