using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>A periodic time of loss: a handover, a loose cable. It adds to the loss that the leg has at all times.</summary>
/// <remarks>Both directions of a link have it at once. Immutable, safe on any thread.</remarks>
public sealed class PeriodicOutage
{
    /// <summary>Creates an outage at the beginning of every period, or of some.</summary>
    /// <param name="periodSeconds">The length of a period, 0.001 to 86,400 s.</param>
    /// <param name="lengthSeconds">How long it lasts; above 0, at most a period.</param>
    /// <param name="lossPercent">See <see cref="LossPercent"/>.</param>
    /// <param name="periodPercent">See <see cref="PeriodPercent"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public PeriodicOutage(double periodSeconds, double lengthSeconds, double lossPercent = 100, double periodPercent = 100)
    {
        Period = Cadence.Period(periodSeconds, nameof(periodSeconds));
        if (!(lengthSeconds > 0 && lengthSeconds <= periodSeconds))
        {
            throw new ArgumentOutOfRangeException(
                nameof(lengthSeconds), lengthSeconds, FormattableString.Invariant($"An outage is longer than 0 and at most its period, {periodSeconds} s."));
        }

        Length = SimDuration.FromSeconds(lengthSeconds);
        LossPercent = Percent(lossPercent, nameof(lossPercent));
        PeriodPercent = Percent(periodPercent, nameof(periodPercent));
    }

    /// <summary>The length of a period.</summary>
    public SimDuration Period { get; }

    /// <summary>How long it lasts.</summary>
    public SimDuration Length { get; }

    /// <summary>The percentage of datagrams lost during an outage, each independently; above 0 to 100, default 100.</summary>
    public double LossPercent { get; }

    /// <summary>The percentage of periods with an outage, at random; above 0 to 100, default 100.</summary>
    public double PeriodPercent { get; }

    private static double Percent(double value, string parameter) =>
        value is > 0 and <= 100 ? value : throw new ArgumentOutOfRangeException(parameter, value, "Must be above 0 and at most 100 %.");
}
