using LagSim.Scenes;

namespace LagSim.Motion;

/// <summary>The cubic, quartic and quintic coefficients of a path whose acceleration is not constant; kept apart so that parabolas do not pay for them.</summary>
internal readonly struct DenseOutput
{
    internal DenseOutput(in Vector3D cubic, in Vector3D quartic, in Vector3D quintic)
    {
        Cubic = cubic;
        Quartic = quartic;
        Quintic = quintic;
    }

    internal Vector3D Cubic { get; }

    internal Vector3D Quartic { get; }

    internal Vector3D Quintic { get; }

    /// <summary>Whether every coefficient is the same, to the bit.</summary>
    internal bool IsSameAs(in DenseOutput other) => Cubic.Equals(other.Cubic) && Quartic.Equals(other.Quartic) && Quintic.Equals(other.Quintic);
}
