using LagSim.Scenes;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>A body inside of another one, or of a surface, with which it collides.</summary>
/// <param name="First">The body.</param>
/// <param name="Second">The other one; null for a surface.</param>
/// <param name="Surface">The name of the surface; empty for another body.</param>
/// <param name="Metres">How deep.</param>
internal sealed record WorldDepth(WorldBody First, WorldBody? Second, string Surface, double Metres)
{
    /// <summary>Which two they are, whatever the instant.</summary>
    internal (BodyId First, BodyId Second, string Surface) Pair => (First.Id, Second?.Id ?? default, Surface);

    internal bool HasHand => First.State.Motion == MotionLaw.Held || Second?.State.Motion == MotionLaw.Held;

    internal bool IsAsleep => First.State.Motion == MotionLaw.Resting && (Second is null || Second.State.Motion == MotionLaw.Resting);

    public override string ToString() => $"{First.Id} in {(Second is null ? $"'{Surface}'" : Second.Id.ToString())}";
}
