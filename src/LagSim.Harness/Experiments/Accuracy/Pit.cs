using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A square pit of vertical walls on a floor at height zero, and a loose cloud of balls over it.</summary>
/// <remarks>Walls and floor leave restitution and friction to the balls.</remarks>
internal static class Pit
{
    /// <summary>The pit, its walls so far from the vertical through the origin.</summary>
    internal static SceneBuilder Dig(SceneBuilder builder, double half) => builder.AddPlane("floor", Vector3D.Up, 0.0)
        .AddPlane("west", new Vector3D(1, 0, 0), -half).AddPlane("east", new Vector3D(-1, 0, 0), -half)
        .AddPlane("north", new Vector3D(0, 0, 1), -half).AddPlane("south", new Vector3D(0, 0, -1), -half);

    /// <summary>Balls in layers over each other, as many in a layer as fit loosely, each a little off its place to a side.</summary>
    /// <param name="builder">The scene.</param>
    /// <param name="balls">The balls, the lowest first.</param>
    /// <param name="largest">The largest radius among them, in metres: it says how far they are apart.</param>
    /// <param name="half">Half the side of the pit, in metres.</param>
    /// <param name="lowest">Where the centres of the lowest layer are, in metres.</param>
    /// <param name="random">By which they are off their places.</param>
    internal static SceneBuilder Pour(
        SceneBuilder builder, IReadOnlyList<BodySpec> balls, double largest, double half, double lowest, SeededRandom random)
    {
        const double loose = 1.2, off = 0.2; // of a diameter; of a radius
        int side = (int)(half / (loose * largest));
        double cell = 2 * half / side;
        for (int n = 0; n < balls.Count; n++)
        {
            double x = ((n % side) + 0.5) * cell, z = ((n / side % side) + 0.5) * cell, y = lowest + (n / (side * side) * 2.5 * largest);
            double dx = random.NextDouble(-off, off) * largest, dz = random.NextDouble(-off, off) * largest;
            builder.AddBody(FormattableString.Invariant($"ball {n + 1}"), balls[n], new Vector3D(x - half + dx, y, z - half + dz));
        }

        return builder;
    }
}
