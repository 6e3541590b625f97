using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>A heap with everything drawn from a seed: the number of balls, their sizes, friction and restitution.</summary>
/// <remarks>No engine is tuned on these heaps. They show whether results on the named heap generalise.</remarks>
internal sealed class RandomHeapWork : ContactWork
{
    internal const string Set = "heaps";

    private const int Heaps = 8;
    private const int Fewest = 20;
    private const int Most = 100;
    private const double Largest = 0.1;
    private const double Half = 0.4;
    private const double MaxRestitution = 0.9;
    private const double WidestRatio = 3;

    private readonly int number;
    private readonly ulong seed;
    private readonly bool isSmall;
    private readonly double friction;
    private readonly double restitution;
    private readonly double[] radii;

    internal RandomHeapWork(int number, ulong seed, bool isSmall = false)
    {
        (this.number, this.seed, this.isSmall) = (number, seed, isSmall);
        SeededRandom random = Generator(number, seed);
        int balls = Fewest + (int)((Most - Fewest + 1) * random.NextDouble());
        (friction, restitution) = (random.NextDouble(), MaxRestitution * random.NextDouble());
        double smallest = Largest / random.NextDouble(1, WidestRatio);
        radii = [.. Enumerable.Range(0, isSmall ? balls / 8 : balls).Select(_ => random.NextDouble(smallest, Largest))];
    }

    public override string Name => $"{Set}-{number}";

    public override string Title => string.Create(
        CultureInfo.InvariantCulture,
        $"heap {number} drawn by seed {seed}: {radii.Length} balls of r {radii.Min():0.###} to {radii.Max():0.###} m,"
            + $" friction {friction:0.##}, restitution {restitution:0.##}, fall into a pit, {Seconds} s");

    public override double Seconds => isSmall ? 1 : 3;

    public override IReadOnlyList<string> ErrorKinds { get; } = [Overlap, EnergyGain];

    public override WorkScene Small => new RandomHeapWork(number, seed, isSmall: true);

    /// <summary>Returns the heaps of a seed.</summary>
    internal static IReadOnlyList<WorkScene> Draw(ulong seed) => [.. Enumerable.Range(1, Heaps).Select(n => new RandomHeapWork(n, seed))];

    /// <summary>Whether a scene of that name is a random heap.</summary>
    internal static bool IsDrawn(string scene) => scene.StartsWith(Set + "-", StringComparison.Ordinal);

    private protected override SceneBuilder Begin()
    {
        BodySpec[] balls = [.. radii.Select(r => new BodySpec(r, Math.Pow(r / Largest, 3), restitution, friction: friction))];
        return Pit.Pour(Pit.Dig(new SceneBuilder(Name), Half), balls, Largest, Half, 3 * Largest, Generator(number, ~seed));
    }

    private static SeededRandom Generator(int number, ulong seed) => new(unchecked((seed * 1_000_003) + (ulong)number));
}
