using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Places around a place, in a fixed order: in 26 directions on each of 64 spheres.</summary>
/// <remarks>Each sphere is half a radius of the ball wider than the one before. First beside, then above, then below. Pure, safe on any thread.</remarks>
internal static class PlacesAround
{
    /// <summary>The last sphere has 32 radii.</summary>
    internal const int Spheres = 64;

    private static readonly Vector3D[] Directions = MakeDirections();

    /// <summary>How many there are.</summary>
    internal static int Count => Spheres * Directions.Length;

    /// <summary>How far away they are at most, and half a radius more, in metres.</summary>
    internal static double Range(double radius) => 0.5 * (Spheres + 1) * radius;

    /// <summary>One of them, by its number from 0.</summary>
    internal static Vector3D At(int number, in Vector3D middle, double radius) =>
        middle + (Directions[number % Directions.Length] * (0.5 * ((number / Directions.Length) + 1) * radius));

    private static Vector3D[] MakeDirections()
    {
        List<Vector3D> directions = new();
        foreach (int y in new[] { 0, 1, -1 })
        {
            for (int x = 1; x >= -1; x--)
            {
                for (int z = 1; z >= -1; z--)
                {
                    if (x != 0 || y != 0 || z != 0)
                    {
                        directions.Add(new Vector3D(x, y, z).Direction);
                    }
                }
            }
        }

        return directions.ToArray();
    }
}
