using System;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.SceneFiles;

/// <summary>Many balls of many sizes in a box with elastic walls, in flight for ever.</summary>
/// <remarks>
/// There is no gravity, which would make crowds of different size differ in height, speed and density. So every ball meets as many others a
/// second whatever their number, and any growth of cost is the engine's.
/// </remarks>
internal static class CrowdScene
{
    internal const string Name = "crowd";
    internal const int DefaultBodies = 200;
    internal const int MaxBodies = 100_000;
    internal const double CellSize = 1;
    internal const double SmallestRadius = 0.15;
    internal const double LargestRadius = 0.3;

    private const double MassOfRadiusCubed = 64; // kg/m^3: a ball of 0.25 m has 1 kg
    private const double SpeedDeviation = 1; // m/s along each axis
    private const ulong Seed = 1;

    /// <summary>Reads the number in <c>crowd</c> or <c>crowd-N</c>, written as a plain number; false for any other text.</summary>
    internal static bool TryParse(string name, out int bodies)
    {
        bodies = DefaultBodies;
        return name == Name
            || (name.StartsWith($"{Name}-", StringComparison.Ordinal)
                && int.TryParse(name.AsSpan(Name.Length + 1), NumberStyles.None, CultureInfo.InvariantCulture, out bodies)
                && bodies is >= 1 and <= MaxBodies
                && name == NameOf(bodies));
    }

    /// <summary>Returns the correct form of a name that means a crowd but is not valid; empty for any other name.</summary>
    internal static string Hint(string name)
    {
        if (!name.StartsWith($"{Name}-", StringComparison.Ordinal))
        {
            return "";
        }

        return int.TryParse(name.AsSpan(Name.Length + 1), NumberStyles.None, CultureInfo.InvariantCulture, out int bodies) && bodies is >= 1 and <= MaxBodies
            ? $"; N is written without leading zeros: {NameOf(bodies)}"
            : $"; N is a whole number from 1 to {MaxBodies}, such as {NameOf(DefaultBodies)}";
    }

    internal static string NameOf(int bodies) => string.Create(CultureInfo.InvariantCulture, $"{Name}-{bodies}");

    /// <summary>Returns the number of cells along each edge of the box. Each ball starts within its own cell.</summary>
    internal static int CellsPerEdge(int bodies)
    {
        int cells = 1;
        while ((long)cells * cells * cells < bodies)
        {
            cells++;
        }

        return cells;
    }

    internal static Scene Build(string name, int bodies)
    {
        int cells = CellsPerEdge(bodies);
        double edge = cells * CellSize;
        SceneBuilder builder = new SceneBuilder(name)
            .WithGravity(Vector3D.Zero)
            .WithSmallestRadius(SmallestRadius)
            .AddPlane("left", new Vector3D(1, 0, 0), 0)
            .AddPlane("right", new Vector3D(-1, 0, 0), -edge)
            .AddPlane("floor", Vector3D.Up, 0)
            .AddPlane("ceiling", new Vector3D(0, -1, 0), -edge)
            .AddPlane("back", new Vector3D(0, 0, 1), 0)
            .AddPlane("front", new Vector3D(0, 0, -1), -edge);
        SeededRandom random = new(Seed);
        SeededRandom sizes = random.Fork(0), places = random.Fork(1), speeds = random.Fork(2);
        long all = (long)cells * cells * cells;
        for (int n = 0; n < bodies; n++)
        {
            // Spread evenly over the cells, so that no part of the box starts empty.
            long cell = n * all / bodies;
            double radius = sizes.NextDouble(SmallestRadius, LargestRadius);
            Vector3D corner = new Vector3D(cell % cells, cell / cells % cells, cell / cells / cells) * CellSize;
            Vector3D within = new(Place(places, radius), Place(places, radius), Place(places, radius));
            Vector3D velocity = new Vector3D(speeds.NextGaussian(), speeds.NextGaussian(), speeds.NextGaussian()) * SpeedDeviation;
            builder.AddBody($"ball {n + 1}", new BodySpec(radius, MassOfRadiusCubed * radius * radius * radius, 1), corner + within, velocity);
        }

        return builder.Build();
    }

    private static double Place(SeededRandom places, double radius) => places.NextDouble(radius, CellSize - radius);
}
