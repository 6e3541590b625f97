using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>A periodic change of rate: a wall between phone and mast, a neighbour's download. Waiting datagrams wait longer.</summary>
/// <remarks>Both directions of a link have it at once, if their periods are the same. Immutable, safe on any thread.</remarks>
public sealed class PeriodicDip
{
    /// <summary>Creates a dip at the beginning of every period.</summary>
    /// <param name="periodSeconds">The length of a period, 0.001 to 86,400 s.</param>
    /// <param name="lengthSeconds">How long it lasts; above 0, at most a period.</param>
    /// <param name="rateBitsPerSecond">See <see cref="RateBitsPerSecond"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public PeriodicDip(double periodSeconds, double lengthSeconds, long rateBitsPerSecond)
    {
        Period = Cadence.Period(periodSeconds, nameof(periodSeconds));
        if (!(lengthSeconds > 0 && lengthSeconds <= periodSeconds))
        {
            throw new ArgumentOutOfRangeException(
                nameof(lengthSeconds), lengthSeconds, FormattableString.Invariant($"A dip is longer than 0 and at most its period, {periodSeconds} s."));
        }

        Length = SimDuration.FromSeconds(lengthSeconds);
        RateBitsPerSecond = Bottleneck.Rate(rateBitsPerSecond, nameof(rateBitsPerSecond));
    }

    /// <summary>The length of a period.</summary>
    public SimDuration Period { get; }

    /// <summary>How long it lasts.</summary>
    public SimDuration Length { get; }

    /// <summary>
    /// The rate during a dip, in bit/s; <see cref="Bottleneck.MinBitsPerSecond"/> to <see cref="Bottleneck.MaxBitsPerSecond"/>.
    /// </summary>
    public long RateBitsPerSecond { get; }
}
