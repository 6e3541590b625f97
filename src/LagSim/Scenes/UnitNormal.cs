using System;

namespace LagSim.Scenes;

/// <summary>The normal of a part of a scene, at unit length.</summary>
internal static class UnitNormal
{
    /// <summary>Makes a normal of any vector. One that has unit length, apart from rounding, stays as it is, so that what is read back has
    /// the same bits.</summary>
    /// <param name="what">What has it.</param>
    /// <param name="name">The name of the part.</param>
    /// <param name="normal">The vector.</param>
    /// <exception cref="SceneException">It has no length, or one that cannot be told.</exception>
    internal static Vector3D Of(string what, string name, in Vector3D normal)
    {
        const double rounding = 2e-15;
        double length = normal.Length;
        if (!normal.IsFinite || !(length > 1e-150 && length < 1e150))
        {
            throw new SceneException($"The normal of {what} '{name}' is {normal}; its length must be between 1e-150 and 1e150.");
        }

        bool isUnit = Math.Abs(normal.LengthSquared - 1) <= rounding;
        return (isUnit ? normal : normal / length).WithoutNegativeZero();
    }
}
