using System;
using System.Globalization;

namespace LagSim.Testing.Links;

/// <summary>
/// A delay that is mostly short and now and then many times as long: log-normal, the leg's delay its median, one more quantile given.
/// </summary>
/// <remarks>
/// <para>That is how a hop over Wi-Fi was measured in the large: there and back a median of 3 ms, a tenth above 20 ms, a hundredth above
/// 250 ms (Sui et al., Characterizing and Improving WiFi Latency in Large-Scale Operational Networks, MobiSys 2016). Of the distributions
/// that two figures fix, the log-normal through the median and the 99th percentile puts the 90th at 34 ms there and back, a Weibull at 49.
/// A log-logistic would be nearer, at 25, but has next to no mean: of a million datagrams one would come a quarter of an hour late.</para>
/// <para>Each datagram's delay is its own; what makes bad moments last is that those sent behind a late one wait for it. So the quantiles
/// hold for datagrams that are sent far apart; sent every few milliseconds, more of them are late.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
public sealed class LongTail
{
    /// <summary>
    /// No datagram takes longer, 2,000 ms: the slowest hop that a session is made for. Without an end one of 100,000 over good Wi-Fi would
    /// take 5 s.
    /// </summary>
    public const double MostMilliseconds = 2_000;

    /// <summary>The tail of which that many of a hundred datagrams take longer than that.</summary>
    /// <param name="percent">See <see cref="Percent"/>.</param>
    /// <param name="aboveMilliseconds">See <see cref="AboveMilliseconds"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is not finite or out of its range.</exception>
    public LongTail(double percent, double aboveMilliseconds)
    {
        if (!(percent is >= 0.001 and <= 49))
        {
            throw new ArgumentOutOfRangeException(nameof(percent), percent, "A long tail has 0.001 to 49 % of the datagrams; the median is the leg's delay.");
        }

        if (!(aboveMilliseconds is > 0 and <= MostMilliseconds))
        {
            throw new ArgumentOutOfRangeException(
                nameof(aboveMilliseconds), aboveMilliseconds, $"A long tail begins above 0 and at most at {MostMilliseconds} ms.");
        }

        Percent = percent;
        AboveMilliseconds = aboveMilliseconds;
    }

    /// <summary>How many of a hundred datagrams take longer than <see cref="AboveMilliseconds"/>, 0.001 to 49.</summary>
    public double Percent { get; }

    /// <summary>
    /// What <see cref="Percent"/> of the datagrams exceed, in milliseconds; above the leg's delay, at most <see cref="MostMilliseconds"/>.
    /// </summary>
    public double AboveMilliseconds { get; }

    /// <summary>Such as <c>1 % above 125 ms</c>.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"{Percent:0.######} % above {AboveMilliseconds:0.######} ms");

    /// <summary>
    /// The standard deviation of the delay's logarithm. Rounded, since the last bits of logarithm and quantile are the platform's.
    /// </summary>
    internal double LogDeviation(double medianMilliseconds) =>
        Math.Round(Math.Log(AboveMilliseconds / medianMilliseconds) / NormalQuantile.Of(1 - (Percent / 100)), 9);
}
