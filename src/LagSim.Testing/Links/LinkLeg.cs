using System;
using System.Globalization;

namespace LagSim.Testing.Links;

/// <summary>What one direction of a link does to datagrams. A link is two of them: it need not be the same both ways.</summary>
/// <remarks>Immutable, safe on any thread. Says what happens on average; each datagram draws from it, by the seed of the network.</remarks>
public sealed class LinkLeg
{
    private readonly LongTail? tail;
    private readonly DelayStep? step;

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

    /// <summary>Mean one-way delay in milliseconds, 0 to <see cref="MaxMilliseconds"/>; with a <see cref="Tail"/> the median.</summary>
    public double DelayMilliseconds { get; }

    /// <summary>Standard deviation of the delay in milliseconds, 0 to <see cref="MaxMilliseconds"/>.</summary>
    public double JitterMilliseconds { get; }

    /// <summary>How many of a hundred datagrams are lost in the long run, 0 to 100.</summary>
    public double LossPercent { get; }

    /// <summary>
    /// How many datagrams are lost in a row on average, at least 1. Losses that know nothing of each other have 1 / (1 - loss).
    /// </summary>
    public double MeanBurstLength { get; }

    /// <summary>How many of a hundred datagrams are held back so that later ones overtake them, 0 to 100.</summary>
    public double ReorderPercent { get; }

    /// <summary>
    /// How long a reordered datagram is held back on average, in milliseconds; uniform from half to one and a half of it.
    /// </summary>
    public double ReorderHoldMilliseconds { get; }

    /// <summary>How many of a hundred datagrams that arrive do so twice, 0 to 100.</summary>
    public double DuplicatePercent { get; }

    /// <summary>
    /// How the delay varies where a standard deviation does not say it; null, the default: by <see cref="JitterMilliseconds"/>.
    /// </summary>
    /// <exception cref="ArgumentException">The leg has jitter too, or the tail does not begin above a delay that is above 0.</exception>
    public LongTail? Tail
    {
        get => tail;
        init
        {
            if (value is not null && (JitterMilliseconds > 0 || DelayMilliseconds == 0 || value.AboveMilliseconds <= DelayMilliseconds))
            {
                throw new ArgumentException(
                    $"A leg of {Text(DelayMilliseconds)} ms with a jitter of {Text(JitterMilliseconds)} ms cannot have {value}: "
                    + "a tail takes the place of jitter and begins above a delay that is above 0 ms.",
                    nameof(value));
            }

            tail = value;
        }
    }

    /// <summary>How the mean delay steps up and down; null, the default: not at all.</summary>
    /// <exception cref="ArgumentException">The step is more than twice the delay, so that it would be below 0 half of the time.</exception>
    public DelayStep? Step
    {
        get => step;
        init => step = value is null || value.Milliseconds <= 2 * DelayMilliseconds
            ? value
            : throw new ArgumentException(
                $"A delay of {Text(DelayMilliseconds)} ms cannot step by {Text(value.Milliseconds)} ms; at most twice the delay is allowed.", nameof(value));
    }

    /// <summary>When it loses more than at other times; null, the default: never.</summary>
    public PeriodicOutage? Outage { get; init; }

    /// <summary>
    /// Where it is narrowest: a rate, and a queue before it, through which a datagram goes before all else; null, the default: as wide as
    /// need be.
    /// </summary>
    public Bottleneck? Bottleneck { get; init; }

    private static double InRange(double value, double low, double high, string parameter) =>
        value >= low && value <= high // false for NaN
            ? value
            : throw new ArgumentOutOfRangeException(parameter, value, $"Must be {Text(low)} to {Text(high)}.");

    private static string Text(double value) => value.ToString("0.######", CultureInfo.InvariantCulture);
}
