using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A time of loss that begins every so often: a handover, a cable that is loose. On top of the loss that the leg has at all times.
/// </summary>
/// <remarks>Both directions of a link have it at once. Immutable, safe on any thread.</remarks>
public sealed class PeriodicOutage
{
    /// <summary>An outage at the beginning of every period, or of some.</summary>
    /// <param name="periodSeconds">The time from one beginning to the next, 0.001 to 86,400 s.</param>
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

    /// <summary>The time from one beginning to the next.</summary>
    public SimDuration Period { get; }

    /// <summary>How long it lasts.</summary>
    public SimDuration Length { get; }

    /// <summary>How many of a hundred datagrams sent meanwhile are lost, each by itself; above 0 to 100, default 100.</summary>
    public double LossPercent { get; }

    /// <summary>How many of a hundred periods have one, by luck; above 0 to 100, default 100.</summary>
    public double PeriodPercent { get; }

    private static double Percent(double value, string parameter) =>
        value is > 0 and <= 100 ? value : throw new ArgumentOutOfRangeException(parameter, value, "Must be above 0 and at most 100 %.");
}
