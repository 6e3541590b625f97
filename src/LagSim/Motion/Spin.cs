using LagSim.Scenes;

namespace LagSim.Motion;

/// <summary>The spin of a body on a segment: the value at its epoch, and an even change, such as friction causes on a plane.</summary>
internal readonly struct Spin
{
    internal Spin(in Vector3D atEpoch, in Vector3D rate = default)
    {
        AtEpoch = atEpoch.WithoutNegativeZero();
        Rate = rate.WithoutNegativeZero();
    }

    /// <summary>In rad/s.</summary>
    internal Vector3D AtEpoch { get; }

    /// <summary>In rad/s².</summary>
    internal Vector3D Rate { get; }

    internal bool IsNone => AtEpoch == Vector3D.Zero && Rate == Vector3D.Zero;

    internal Vector3D At(double seconds) => AtEpoch + (Rate * seconds);

    /// <summary>Whether every part is the same, to the bit.</summary>
    internal bool IsSameAs(in Spin other) => AtEpoch.Equals(other.AtEpoch) && Rate.Equals(other.Rate);
}
