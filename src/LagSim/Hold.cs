using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <summary>Which peer holds a body, by which point, and when the hand's last keyframe was.</summary>
/// <remarks>Immutable, safe on any thread. It belongs to a segment of the body's path, and is cut and kept with it.</remarks>
public readonly struct Hold : IEquatable<Hold>
{
    /// <summary>Creates a hold with these values.</summary>
    public Hold(byte peer, in Vector3D offset, SimTime keyframeTime)
    {
        Peer = peer;
        Offset = offset;
        KeyframeTime = keyframeTime;
    }

    /// <summary>The peer that holds the body.</summary>
    public byte Peer { get; }

    /// <summary>From the body's centre to the hand's point, in metres; fixed while the hold lasts.</summary>
    public Vector3D Offset { get; }

    /// <summary>
    /// The time of the hand's last keyframe, or of the grab. The hold ends by itself <see cref="Motion.HandPath.Lasts"/> later.
    /// </summary>
    public SimTime KeyframeTime { get; }

    /// <inheritdoc/>
    public bool Equals(Hold other) => Peer == other.Peer && Offset.Equals(other.Offset) && KeyframeTime == other.KeyframeTime;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Hold other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => KeyframeTime.GetHashCode() ^ (Offset.GetHashCode() * 397) ^ Peer;

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in Hold a, in Hold b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in Hold a, in Hold b) => !a.Equals(b);
}
