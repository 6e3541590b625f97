using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <summary>Which peer holds a body, by which point, how strong the hand is, and when its last keyframe was.</summary>
/// <remarks>Immutable, safe on any thread. It belongs to a segment of the body's path, and is cut and kept with it.</remarks>
public readonly struct Hold : IEquatable<Hold>
{
    /// <summary>Creates a hold with these values.</summary>
    /// <param name="peer">See <see cref="Peer"/>.</param>
    /// <param name="offset">See <see cref="Offset"/>.</param>
    /// <param name="keyframeTime">See <see cref="KeyframeTime"/>.</param>
    /// <param name="maxForce">See <see cref="MaxForce"/>.</param>
    /// <param name="maxPower">See <see cref="MaxPower"/>.</param>
    /// <param name="busyUntil">See <see cref="BusyUntil"/>.</param>
    public Hold(byte peer, in Vector3D offset, SimTime keyframeTime, double maxForce = 0, double maxPower = 0, SimTime busyUntil = default)
    {
        Peer = peer;
        Offset = offset;
        KeyframeTime = keyframeTime;
        MaxForce = maxForce;
        MaxPower = maxPower;
        BusyUntil = busyUntil;
    }

    /// <summary>The peer that holds the body.</summary>
    public byte Peer { get; }

    /// <summary>From the body's centre to the hand's point, in metres; fixed while the hold lasts.</summary>
    public Vector3D Offset { get; }

    /// <summary>
    /// The time of the hand's last keyframe, or of the grab. The hold ends by itself <see cref="Motion.HandPath.Lasts"/> later.
    /// </summary>
    public SimTime KeyframeTime { get; }

    /// <summary>The hand's greatest force in N, as its grab said; 0 for the default (<see cref="Motion.HandStrength.DefaultForce"/>).</summary>
    public double MaxForce { get; }

    /// <summary>The hand's greatest power in W, as its grab said; 0 for the default (<see cref="Motion.HandStrength.DefaultPower"/>).</summary>
    public double MaxPower { get; }

    /// <summary>
    /// Until when the hand would push with all its force to give what it has given in impacts; the default if that is over. It is never later
    /// than a blow (<see cref="Motion.HandStrength"/>) after the last impact.
    /// </summary>
    public SimTime BusyUntil { get; }

    /// <summary>What is left at an instant of being busy: so holds that only were busy once are equal.</summary>
    internal SimTime BusyAt(SimTime now) => BusyUntil != default && BusyUntil > now ? BusyUntil : default;

    /// <summary>The same hold, with a keyframe at an instant.</summary>
    internal Hold WithKeyframe(SimTime time) => new(Peer, Offset, time, MaxForce, MaxPower, BusyAt(time));

    /// <summary>The same hold, busy for so long.</summary>
    internal Hold Busy(SimTime until) => new(Peer, Offset, KeyframeTime, MaxForce, MaxPower, until);

    /// <inheritdoc/>
    public bool Equals(Hold other) =>
        Peer == other.Peer && Offset.Equals(other.Offset) && KeyframeTime == other.KeyframeTime && MaxForce.Equals(other.MaxForce)
        && MaxPower.Equals(other.MaxPower) && BusyUntil == other.BusyUntil;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Hold other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => KeyframeTime.GetHashCode() ^ (Offset.GetHashCode() * 397) ^ Peer;

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in Hold a, in Hold b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in Hold a, in Hold b) => !a.Equals(b);
}
