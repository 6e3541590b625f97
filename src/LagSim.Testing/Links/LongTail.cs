using System;
using System.Globalization;

namespace LagSim.Testing.Links;

/// <summary>
/// A delay that is mostly short and occasionally many times as long: log-normal, with the leg's delay as median and one more quantile.
/// </summary>
/// <remarks>
/// <para>This matches large-scale measurements of a Wi-Fi hop: a median round trip of 3 ms, a tenth above 20 ms, a hundredth above 250 ms
/// (Sui et al., Characterizing and Improving WiFi Latency in Large-Scale Operational Networks, MobiSys 2016). Of the distributions fixed by
/// two figures, the log-normal through the median and the 99th percentile puts the 90th at 34 ms round trip, a Weibull at 49. A
/// log-logistic would be nearer, at 25, but has next to no mean: of a million datagrams one would come a quarter of an hour late.</para>
/// <para>Each datagram's delay is independent; bad moments last because datagrams sent behind a late one wait for it. So the quantiles hold
/// for datagrams sent far apart; sent every few milliseconds, more of them are late.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class LongTail
{
    /// <summary>
    /// The longest delay of a datagram, 2,000 ms: the slowest hop that a session is made for. Without a limit one of 100,000 over good
    /// Wi-Fi would take 5 s.
    /// </summary>
    public const double MaxMilliseconds = 2_000;

    /// <summary>Creates a tail in which that percentage of datagrams takes longer than that time.</summary>
    /// <param name="percent">See <see cref="Percent"/>.</param>
    /// <param name="aboveMilliseconds">See <see cref="AboveMilliseconds"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public LongTail(double percent, double aboveMilliseconds)
    {
        if (!(percent is >= 0.001 and <= 49))
        {
            throw new ArgumentOutOfRangeException(nameof(percent), percent, "A long tail has 0.001 to 49 % of the datagrams; the median is the leg's delay.");
        }

        if (!(aboveMilliseconds is > 0 and <= MaxMilliseconds))
        {
            throw new ArgumentOutOfRangeException(
                nameof(aboveMilliseconds), aboveMilliseconds, $"A long tail begins above 0 and at most at {MaxMilliseconds} ms.");
        }

        Percent = percent;
        AboveMilliseconds = aboveMilliseconds;
    }

    /// <summary>The percentage of datagrams that take longer than <see cref="AboveMilliseconds"/>, 0.001 to 49.</summary>
    public double Percent { get; }

    /// <summary>
    /// The delay that <see cref="Percent"/> of the datagrams exceed, in milliseconds; above the leg's delay, at most
    /// <see cref="MaxMilliseconds"/>.
    /// </summary>
    public double AboveMilliseconds { get; }

    /// <summary>Such as <c>1 % above 125 ms</c>.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Percent:0.######} % above {AboveMilliseconds:0.######} ms");

    /// <summary>
    /// The standard deviation of the delay's logarithm, rounded because the last bits of logarithm and quantile depend on the platform.
    /// </summary>
    internal double LogDeviation(double medianMilliseconds) =>
        Math.Round(Math.Log(AboveMilliseconds / medianMilliseconds) / NormalQuantile.Of(1 - (Percent / 100)), 9);
}
