using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// What a heap of 64 unequal balls with friction costs at the default contact tolerance, by restitution and by how unlike their masses are.
/// </summary>
internal static class UnequalHeapTable
{
    private const double Seconds = 3;
    private const int Side = 4;
    private const int Runs = 3;
    private const double Cell = 0.36;

    /// <summary>So unlike are masses where all balls have one density; beyond it they are drawn.</summary>
    private const double OfOneDensity = 8;

    internal static void Print(bool brief)
    {
        Measure(0.2, 1, 1, 0.3);
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"64 balls of radii 0.08 to 0.16 m, friction 0.4, dropped into a pit {Side * Cell:0.##} m wide; the first {Seconds} s, "
            + $"{Runs} drawn heaps each; share of real time on one core"));
        Console.WriteLine("| restitution | masses, kg | least | middle | most | its most expensive quarter of a second |");
        Console.WriteLine("|---|---|---|---|---|---|");
        double[] restitutions = brief ? [0.2] : [0.2, 0.9, 0.99, 1];
        double[] unlike = brief ? [OfOneDensity] : [OfOneDensity, 100];
        foreach (double ratio in unlike)
        {
            foreach (double e in restitutions)
            {
                List<(double Mean, double Dearest)> runs =
                    [.. Enumerable.Range(1, Runs).Select(seed => Measure(e, ratio, seed, brief ? 0.3 : Seconds)).OrderBy(run => run.Mean)];
                Console.WriteLine(string.Create(
                    CultureInfo.InvariantCulture,
                    $"| {e} | 1 to {ratio} | {runs[0].Mean:0.00} | {runs[1].Mean:0.00} | {runs[2].Mean:0.00} | {runs[2].Dearest:0.00} |"));
            }
        }
    }

    private static (double Mean, double Dearest) Measure(double restitution, double ratio, int seed, double seconds)
    {
        Simulation world = new(Heap(restitution, ratio, seed), new SimulationOptions());
        double dearest = 0, sum = 0;
        for (double t = 0.25; t <= seconds; t += 0.25)
        {
            Stopwatch watch = Stopwatch.StartNew();
            world.AdvanceTo(SimTime.FromSeconds(t));
            dearest = Math.Max(dearest, watch.Elapsed.TotalSeconds * 4);
            sum += watch.Elapsed.TotalSeconds;
        }

        return (sum / seconds, dearest);
    }

    private static Scene Heap(double restitution, double ratio, int seed)
    {
        double half = Side * Cell / 2;
        Random random = new(seed);
        SceneBuilder builder = new SceneBuilder("unequal").AddPlane("floor", Vector3D.Up, 0.0, restitution)
            .AddPlane("west", new Vector3D(1, 0, 0), -half, restitution).AddPlane("east", new Vector3D(-1, 0, 0), -half, restitution)
            .AddPlane("north", new Vector3D(0, 0, 1), -half, restitution).AddPlane("south", new Vector3D(0, 0, -1), -half, restitution);
        for (int n = 0; n < Side * Side * Side; n++)
        {
            double radius = 0.08 + (0.08 * random.NextDouble());
            double mass = ratio <= OfOneDensity ? Math.Pow(radius / 0.08, 3) : Math.Pow(ratio, random.NextDouble());
            Vector3D place = new(Place(n % Side) - half, Place(n / (Side * Side)) + 0.2, Place(n / Side % Side) - half);
            builder.AddBody($"ball {n}", new BodySpec(radius, mass, restitution, friction: 0.4), place);
        }

        return builder.Build();

        double Place(int n) => (Cell * (n + 0.5)) + (0.03 * (random.NextDouble() - 0.5));
    }
}
