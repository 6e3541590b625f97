using LagSim.Scenes;

namespace LagSim.Net.Display;

/// <summary>A sample of a hand of this player.</summary>
internal readonly struct OwnHand(BodyId body, byte peer, in Vector3D position)
{
    /// <summary>The body that it holds.</summary>
    internal readonly BodyId Body = body;

    /// <summary>This player's number.</summary>
    internal readonly byte Peer = peer;

    /// <summary>Where the hand's point is, in metres.</summary>
    internal readonly Vector3D Position = position;
}
