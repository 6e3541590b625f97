using System;
using System.Globalization;

namespace LagSim.Testing.Links;

/// <summary>The effect of one direction of a link on datagrams. A link has two, which may differ.</summary>
/// <remarks>Immutable, safe on any thread. It describes averages; each datagram draws from it, by the seed of the network.</remarks>
public sealed class LinkLeg
{
    private readonly LongTail? tail;
    private readonly DelayStep? step;

    /// <summary>The longest delay, jitter or hold a leg can have, in milliseconds: ten minutes.</summary>
    public const double MaxMilliseconds = 600_000;

    /// <summary>Creates a leg with these properties; omitted ones have no effect.</summary>
    /// <param name="delayMilliseconds">See <see cref="DelayMilliseconds"/>.</param>
    /// <param name="jitterMilliseconds">See <see cref="JitterMilliseconds"/>.</param>
    /// <param name="lossPercent">See <see cref="LossPercent"/>.</param>
    /// <param name="meanBurstLength">See <see cref="MeanBurstLength"/>.</param>
    /// <param name="reorderPercent">See <see cref="ReorderPercent"/>.</param>
    /// <param name="duplicatePercent">See <see cref="DuplicatePercent"/>.</param>
    /// <param name="reorderHoldMilliseconds">See <see cref="ReorderHoldMilliseconds"/>; left out, half of the delay.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of range.</exception>
    /// <exception cref="ArgumentException">That much loss cannot come in bursts that short, or reordering has no hold.</exception>
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

    /// <summary>The long-run percentage of datagrams lost, 0 to 100.</summary>
    public double LossPercent { get; }

    /// <summary>The mean number of datagrams lost in a row, at least 1. Independent losses have 1 / (1 - loss).</summary>
    public double MeanBurstLength { get; }

    /// <summary>The percentage of datagrams held back so that later ones overtake them, 0 to 100.</summary>
    public double ReorderPercent { get; }

    /// <summary>
    /// The mean time for which a reordered datagram is held back, in milliseconds; uniform from half to one and a half of it.
    /// </summary>
    public double ReorderHoldMilliseconds { get; }

    /// <summary>The percentage of arriving datagrams that arrive twice, 0 to 100.</summary>
    public double DuplicatePercent { get; }

    /// <summary>
    /// How the delay varies if a standard deviation does not describe it; null, the default, for <see cref="JitterMilliseconds"/>.
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

    /// <summary>How the mean delay steps up and down; null, the default, for not at all.</summary>
    /// <exception cref="ArgumentException">The step is more than twice the delay, so that it would be below 0 half of the time.</exception>
    public DelayStep? Step
    {
        get => step;
        init => step = value is null || value.Milliseconds <= 2 * DelayMilliseconds
            ? value
            : throw new ArgumentException(
                $"A delay of {Text(DelayMilliseconds)} ms cannot step by {Text(value.Milliseconds)} ms; at most twice the delay is allowed.", nameof(value));
    }

    /// <summary>Periods of higher loss; null, the default, for none.</summary>
    public PeriodicOutage? Outage { get; init; }

    /// <summary>
    /// The narrowest point: a rate, and a queue before it, which a datagram passes before everything else; null, the default, for unlimited
    /// width.
    /// </summary>
    public Bottleneck? Bottleneck { get; init; }

    private static double InRange(double value, double low, double high, string parameter) =>
        value >= low && value <= high // false for NaN
            ? value
            : throw new ArgumentOutOfRangeException(parameter, value, $"Must be {Text(low)} to {Text(high)}.");

    private static string Text(double value) => value.ToString("0.######", CultureInfo.InvariantCulture);
}
