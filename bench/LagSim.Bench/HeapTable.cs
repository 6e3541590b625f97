using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// The cost of heaps of balls in persistent contact, the most expensive scenes there are: by size, with and without friction, and several
/// heaps at once.
/// </summary>
internal static class HeapTable
{
    private const double Seconds = 3;

    internal static void Print(bool brief)
    {
        Print(new Row(1, 9, 0.3)); // for the compiler
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"Heaps of balls of 0.5 m and 1 kg, three by three a layer, let fall into a groove whose sides stand at 45 degrees, restitution 0.2; the first {Seconds} s; wall clock"));
        Console.WriteLine(
            "| heaps | balls in each | friction | ms for a simulated second, the most expensive quarter of one | the mean | events | hash |");
        Console.WriteLine("|---|---|---|---|---|---|---|");
        Row[] rows = brief
            ? [new(1, 9, 0.3), new(2, 9, 0.3)]
            :
            [
                new(1, 9, 0), new(1, 9, 0.3), new(1, 18, 0), new(1, 18, 0.3), new(1, 63, 0), new(1, 63, 0.3), new(1, 200, 0.3), new(2, 18, 0.3), new(8, 18, 0.3), new(64, 18, 0.3),
            ];
        foreach (Row row in rows)
        {
            Console.WriteLine(Print(row));
        }
    }

    /// <summary>Three times, the middle one.</summary>
    private static string Print(Row row)
    {
        Scene scene = Heaps(row);
        List<(double Dearest, double Mean)> runs = [];
        string end = "";
        for (int run = 0; run < 3; run++)
        {
            Simulation world = new(scene, new SimulationOptions());
            double dearest = 0, sum = 0;
            for (double t = 0.25; t <= Seconds; t += 0.25)
            {
                Stopwatch watch = Stopwatch.StartNew();
                world.AdvanceTo(SimTime.FromSeconds(t));
                dearest = Math.Max(dearest, watch.Elapsed.TotalMilliseconds);
                sum += watch.Elapsed.TotalMilliseconds;
            }

            runs.Add((dearest * 4, sum / Seconds));
            end = string.Create(CultureInfo.InvariantCulture, $"{world.EventsProcessed:N0} | {world.EventHash(SimTime.FromSeconds(Seconds)):x16}");
        }

        runs.Sort((a, b) => a.Mean.CompareTo(b.Mean));
        return string.Create(CultureInfo.InvariantCulture, $"| {row.Heaps} | {row.Balls} | {row.Friction} | {runs[1].Dearest:N0} | {runs[1].Mean:N0} | {end} |");
    }

    private static Scene Heaps(Row row)
    {
        double half = Math.Sqrt(0.5);
        Random random = new(7);
        SceneBuilder builder = new SceneBuilder("heaps").AddPlane("left", new Vector3D(half, half, 0), 0.0, 0.2).AddPlane("right", new Vector3D(-half, half, 0), 0.0, 0.2);
        BodySpec ball = new(0.5, 1, 0.2, friction: row.Friction);
        for (int n = 0; n < row.Heaps * row.Balls; n++)
        {
            int heap = n / row.Balls, place = n % row.Balls;
            double left = Place(place % 3), right = Place(place / 3 % 3), along = Place(place / 9) + (heap * 60);
            builder.AddBody($"ball {n}", ball, new Vector3D((left - right) * half, (left + right) * half, along));
        }

        return builder.Build();

        double Place(int n) => 0.53 + (1.06 * n) + (0.02 * random.NextDouble());
    }

    private readonly record struct Row(int Heaps, int Balls, double Friction);
}
