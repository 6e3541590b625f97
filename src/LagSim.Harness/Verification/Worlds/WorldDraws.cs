using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Random draws for worlds.</summary>
internal static class WorldDraws
{
    /// <summary>Uniform in the logarithm.</summary>
    internal static double LogUniform(SeededRandom from, double low, double high) =>
        low * SeededRandom.Exp(from.NextDouble() * SeededRandom.Log(high / low));

    /// <summary>Each component uniform in -1 to 1, times a size.</summary>
    internal static Vector3D InCube(SeededRandom from, double half) =>
        new Vector3D(from.NextDouble(-1, 1), from.NextDouble(-1, 1), from.NextDouble(-1, 1)) * half;

    /// <summary>A direction: any, or along an axis, as what stands on a floor is pushed.</summary>
    internal static Vector3D Direction(SeededRandom from)
    {
        if (from.IsLucky(30))
        {
            double sign = from.IsLucky(50) ? 1 : -1;
            return from.Pick(new Vector3D(sign, 0, 0), new Vector3D(0, sign, 0), new Vector3D(0, 0, sign));
        }

        Vector3D any = InCube(from, 1);
        return any.LengthSquared > 1e-6 ? any * (1 / any.Length) : Vector3D.Up;
    }
}
