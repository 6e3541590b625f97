namespace LagSim.Testing.Links;

/// <summary>Random draws for generated sessions.</summary>
internal static class RandomDraws
{
    /// <summary>Uniform in 0 to <paramref name="count"/> - 1.</summary>
    internal static int NextInt(this SeededRandom random, int count) => (int)(random.NextDouble() * count);

    /// <summary>True for that percentage of draws.</summary>
    internal static bool IsLucky(this SeededRandom random, double percent) => random.NextDouble() * 100 < percent;

    internal static T Pick<T>(this SeededRandom random, params T[] from) => from[random.NextInt(from.Length)];
}
