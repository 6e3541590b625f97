namespace LagSim.Testing.Links;

/// <summary>What sessions are drawn with.</summary>
internal static class RandomDraws
{
    /// <summary>Uniform in 0 to <paramref name="count"/> - 1.</summary>
    internal static int NextInt(this SeededRandom random, int count) => (int)(random.NextDouble() * count);

    /// <summary>True in so many of a hundred draws.</summary>
    internal static bool IsLucky(this SeededRandom random, double percent) => random.NextDouble() * 100 < percent;

    internal static T Pick<T>(this SeededRandom random, params T[] from) => from[random.NextInt(from.Length)];
}
