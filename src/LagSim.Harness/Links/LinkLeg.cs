using System;
using System.Globalization;

namespace LagSim.Harness.Links;

/// <summary>What one direction of a link does to datagrams. A link is two of them: it need not be the same both ways.</summary>
/// <remarks>Immutable, safe on any thread. Says what happens on average; <see cref="LinkModel"/> draws from it.</remarks>
public sealed class LinkLeg
{
    /// <summary>The longest delay, jitter or hold a leg can have, in milliseconds: ten minutes.</summary>
    public const double MaxMilliseconds = 600_000;

    /// <summary>A leg of these properties; all that is left out does nothing.</summary>
    /// <param name="delayMilliseconds">See <see cref="DelayMilliseconds"/>.</param>
    /// <param name="jitterMilliseconds">See <see cref="JitterMilliseconds"/>.</param>
    /// <param name="lossPercent">See <see cref="LossPercent"/>.</param>
    /// <param name="meanBurstLength">See <see cref="MeanBurstLength"/>.</param>
    /// <param name="reorderPercent">See <see cref="ReorderPercent"/>.</param>
    /// <param name="duplicatePercent">See <see cref="DuplicatePercent"/>.</param>
    /// <param name="reorderHoldMilliseconds">See <see cref="ReorderHoldMilliseconds"/>; left out, half of the delay.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    /// <exception cref="ArgumentException">So much loss cannot come in bursts that short, or reordering has no hold.</exception>
    public LinkLeg(
        double delayMilliseconds,
        double jitterMilliseconds = 0,
        double lossPercent = 0,
        double meanBurstLength = 1,
        double reorderPercent = 0,
        double duplicatePercent = 0,
        double? reorderHoldMilliseconds = null)
    {
        DelayMilliseconds = InRange(delayMilliseconds, 0, MaxMilliseconds, nameof(delayMilliseconds));
        JitterMilliseconds = InRange(jitterMilliseconds, 0, MaxMilliseconds, nameof(jitterMilliseconds));
        LossPercent = InRange(lossPercent, 0, 100, nameof(lossPercent));
        MeanBurstLength = InRange(meanBurstLength, 1, 1e9, nameof(meanBurstLength));
        ReorderPercent = InRange(reorderPercent, 0, 100, nameof(reorderPercent));
        DuplicatePercent = InRange(duplicatePercent, 0, 100, nameof(duplicatePercent));
        ReorderHoldMilliseconds =
            InRange(reorderHoldMilliseconds ?? (delayMilliseconds / 2), 0, MaxMilliseconds, nameof(reorderHoldMilliseconds));

        if (lossPercent < 100 && lossPercent > meanBurstLength * (100 - lossPercent))
        {
            throw new ArgumentException(
                $"{Text(lossPercent)} % loss needs a mean burst of at least {Text(lossPercent / (100 - lossPercent))} datagrams, not {Text(meanBurstLength)}.",
                nameof(meanBurstLength));
        }

        if (reorderPercent > 0 && ReorderHoldMilliseconds == 0)
        {
            throw new ArgumentException("A leg that reorders must hold datagrams back for more than 0 ms.", nameof(reorderHoldMilliseconds));
        }
    }

    /// <summary>Mean one-way delay in milliseconds, 0 to <see cref="MaxMilliseconds"/>.</summary>
    public double DelayMilliseconds { get; }

    /// <summary>Standard deviation of the delay in milliseconds, 0 to <see cref="MaxMilliseconds"/>.</summary>
    public double JitterMilliseconds { get; }

    /// <summary>How many of a hundred datagrams are lost in the long run, 0 to 100.</summary>
    public double LossPercent { get; }

    /// <summary>How many datagrams are lost in a row on average, at least 1. Losses that know nothing of each other have 1 / (1 - loss).</summary>
    public double MeanBurstLength { get; }

    /// <summary>How many of a hundred datagrams are held back so that later ones overtake them, 0 to 100.</summary>
    public double ReorderPercent { get; }

    /// <summary>How long a reordered datagram is held back on average, in milliseconds; uniform from half to one and a half of it.</summary>
    public double ReorderHoldMilliseconds { get; }

    /// <summary>How many of a hundred datagrams that arrive do so twice, 0 to 100.</summary>
    public double DuplicatePercent { get; }

    private static double InRange(double value, double low, double high, string parameter) =>
        value >= low && value <= high // false for NaN
            ? value
            : throw new ArgumentOutOfRangeException(parameter, value, $"Must be {Text(low)} to {Text(high)}.");

    private static string Text(double value) => value.ToString("0.######", CultureInfo.InvariantCulture);
}
