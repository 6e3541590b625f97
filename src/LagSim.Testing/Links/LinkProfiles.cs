using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Globalization;
using System.Linq;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>The link profiles that the project reports on, by name.</summary>
/// <remarks>All are one hop between a player and the host. Immutable, safe on any thread.</remarks>
public static class LinkProfiles
{
    /// <summary>The longest pure delay, in milliseconds.</summary>
    public const double MaxPureDelay = 2_000;

    /// <summary>The names accepted besides those of <see cref="All"/>, for help and errors.</summary>
    public static readonly string AnyDelay = $"delay-Nms for any N from 0 to {MaxPureDelay}";

    private const string DelayPrefix = "delay-";
    private const string DelaySuffix = "ms";

    private static readonly double[] LadderSteps = [0, 10, 20, 50, 100, 200, 500, 1000, 2000];

    /// <summary>Two processes on one machine: 0.05 ms, jitter 0.01 ms.</summary>
    public static LinkProfile Loopback { get; } = new("loopback", new LinkLeg(0.05, 0.01));

    /// <summary>Two machines on one wired network: 0.3 ms, jitter 0.05 ms.</summary>
    public static LinkProfile Lan { get; } = new("lan", new LinkLeg(0.3, 0.05));

    /// <summary>As <see cref="Lan"/>, but a player's clock is 1.24 s ahead of the host's, as for the thesis's two machines.</summary>
    public static LinkProfile SkewedClock { get; } =
        new("skewed-clock", new LinkLeg(0.3, 0.05), SimDuration.FromMilliseconds(1240));

    /// <summary>A quiet Wi-Fi network: usually 1.5 ms, but 1 % take longer than 125 ms; 0.1 % lost in bursts of 2.</summary>
    public static LinkProfile WifiGood { get; } =
        new("wifi-good", new LinkLeg(1.5, lossPercent: 0.1, meanBurstLength: 2) { Tail = new LongTail(percent: 1, aboveMilliseconds: 125) });

    /// <summary>A crowded Wi-Fi network: usually 10 ms, but 10 % take longer than 50 ms; 1 % lost in bursts of 3.</summary>
    public static LinkProfile WifiBusy { get; } =
        new("wifi-busy", new LinkLeg(10, lossPercent: 1, meanBurstLength: 3) { Tail = new LongTail(percent: 10, aboveMilliseconds: 50) });

    /// <summary>A 4G phone: 45 ms, jitter 5 ms down and 15 ms up, 0.2 % lost in bursts of 1.5.</summary>
    public static LinkProfile FourG { get; } = new("4g", toHost: new LinkLeg(45, 15, 0.2, 1.5), fromHost: new LinkLeg(45, 5, 0.2, 1.5));

    /// <summary>A 3G phone: 125 ms, jitter 50 ms, 0.5 % lost in bursts of 2.</summary>
    public static LinkProfile ThreeG { get; } = new("3g", new LinkLeg(125, 50, 0.5, 2));

    /// <summary>A 5G phone: 7 ms down and 18 ms up, jitter 2 ms and 4 ms, 0.1 % lost in bursts of 1.5.</summary>
    public static LinkProfile FiveG { get; } = new("5g", toHost: new LinkLeg(18, 4, 0.1, 1.5), fromHost: new LinkLeg(7, 2, 0.1, 1.5));

    /// <summary>
    /// Satellites in low orbit, changing every 15 s: 25 ms, jitter 7 ms, a step of 10 ms at each handover; 0.3 % lost one by one, and half
    /// of the datagrams sent in the first 200 ms after every second handover on average.
    /// </summary>
    public static LinkProfile Starlink { get; } = new("starlink", new LinkLeg(25, 7, lossPercent: 0.3, meanBurstLength: 1 / 0.997)
    {
        Step = new DelayStep(periodSeconds: 15, milliseconds: 10),
        Outage = new PeriodicOutage(periodSeconds: 15, lengthSeconds: 0.2, lossPercent: 50, periodPercent: 50),
    });

    /// <summary>Across the Atlantic: 39 ms, jitter 1 ms, 0.1 % lost in bursts of 1.5.</summary>
    public static LinkProfile Transatlantic { get; } = new("transatlantic", new LinkLeg(39, 1, 0.1, 1.5));

    /// <summary>From Europe to Australia: 174 ms, jitter 3 ms, 0.2 % lost in bursts of 2.</summary>
    public static LinkProfile EuAustralia { get; } = new("eu-australia", new LinkLeg(174, 3, 0.2, 2));

    /// <summary>A geostationary satellite: 325 ms, jitter 10 ms, 0.5 % lost in bursts of 2.</summary>
    public static LinkProfile Satellite { get; } = new("satellite", new LinkLeg(325, 10, 0.5, 2));

    /// <summary>
    /// Everything at once, to break things with: 200 ms, jitter 60 ms, 10 % lost in bursts of 5, 5 % reordered, 2 % duplicated.
    /// </summary>
    public static LinkProfile Awful { get; } =
        new("awful", new LinkLeg(200, 60, lossPercent: 10, meanBurstLength: 5, reorderPercent: 5, duplicatePercent: 2));

    /// <summary>A link that is gone for 1.5 s every 20 s, both ways at once: 40 ms, jitter 2 ms, and no loss in between.</summary>
    public static LinkProfile Blackout { get; } =
        new("blackout", new LinkLeg(40, 2) { Outage = new PeriodicOutage(periodSeconds: 20, lengthSeconds: 1.5) });

    /// <summary>A slow ADSL line: 25 ms, jitter 2 ms; 256 kbit/s up and 2 Mbit/s down, with a queue of 500 ms each.</summary>
    public static LinkProfile Dsl256K { get; } = new(
        "dsl-256k",
        toHost: new LinkLeg(25, 2) { Bottleneck = new Bottleneck(256_000, 500) },
        fromHost: new LinkLeg(25, 2) { Bottleneck = new Bottleneck(2_000_000, 500) });

    /// <summary>A modem, or a phone at the edge of its cell: 60 ms, jitter 5 ms; 64 kbit/s each way, with a queue of 1 s.</summary>
    public static LinkProfile Modem64K { get; } = new("modem-64k", new LinkLeg(60, 5) { Bottleneck = new Bottleneck(64_000, 1_000) });

    /// <summary>
    /// A line with a queue that is much too long, during a download: 20 ms, jitter 2 ms; 1 Mbit/s each way, with a queue of 2 s.
    /// </summary>
    public static LinkProfile Bufferbloat { get; } =
        new("bufferbloat", new LinkLeg(20, 2) { Bottleneck = new Bottleneck(1_000_000, 2_000) }) { HasBulkTransfer = true };

    /// <summary>
    /// A line that narrows for 5 s every 30 s, both ways at once: 40 ms, jitter 2 ms; 512 kbit/s, then 100 kbit/s, with a queue of 1 s.
    /// </summary>
    public static LinkProfile Dip { get; } = new("dip", new LinkLeg(40, 2)
    {
        Bottleneck = new Bottleneck(512_000, 1_000) { Dip = new PeriodicDip(periodSeconds: 30, lengthSeconds: 5, rateBitsPerSecond: 100_000) },
    });

    /// <summary>Pure delays from nothing to 2 s: 0, 10, 20, 50, 100, 200, 500, 1000, 2000 ms one way.</summary>
    public static IReadOnlyList<LinkProfile> Ladder { get; } = Array.ConvertAll(LadderSteps, PureDelay);

    /// <summary>Every named profile, the ladder last.</summary>
    public static IReadOnlyList<LinkProfile> All { get; } =
    [
        Loopback, Lan, SkewedClock, WifiGood, WifiBusy, FourG, ThreeG, FiveG, Starlink, Transatlantic, EuAustralia, Satellite, Awful, Blackout,
        Dsl256K, Modem64K, Bufferbloat, Dip,
        .. Ladder,
    ];

    /// <summary>The names of <see cref="All"/>, in that order: the rows of a test that runs on every link.</summary>
    public static IReadOnlyList<string> Names { get; } = [.. All.Select(known => known.Name)];

    /// <summary>
    /// Creates a link that delays every datagram by the same time each way and does nothing else, named <c>delay-25ms</c> for 25.
    /// </summary>
    /// <param name="milliseconds">
    /// The delay one way, 0 to <see cref="MaxPureDelay"/>; rounded to a nanosecond, so that the name is exact.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="milliseconds"/> is not finite or out of range.</exception>
    public static LinkProfile PureDelay(double milliseconds)
    {
        if (!(milliseconds is >= 0 and <= MaxPureDelay))
        {
            throw new ArgumentOutOfRangeException(nameof(milliseconds), milliseconds, $"A pure delay is 0 to {MaxPureDelay} ms.");
        }

        double rounded = Math.Round(milliseconds, 6);
        string name = DelayPrefix + rounded.ToString("0.######", CultureInfo.InvariantCulture) + DelaySuffix;
        return new LinkProfile(name, new LinkLeg(rounded));
    }

    /// <summary>Returns the profile of that name: one of <see cref="All"/>, or any <c>delay-Nms</c>.</summary>
    /// <param name="name">Case matters.</param>
    /// <exception cref="ArgumentException">There is no such profile; the message lists those that exist.</exception>
    public static LinkProfile Get(string name) => TryGet(name, out LinkProfile? profile, out string? error) ? profile : throw new ArgumentException(error, nameof(name));

    /// <summary>Finds the profile of that name.</summary>
    /// <param name="name">Case matters.</param>
    /// <param name="profile">The profile, if there is one.</param>
    /// <param name="error">Otherwise a sentence that lists those that exist.</param>
    public static bool TryGet(
        string name, [NotNullWhen(true)] out LinkProfile? profile, [NotNullWhen(false)] out string? error)
    {
        ArgumentNullException.ThrowIfNull(name);
        profile = All.FirstOrDefault(known => known.Name == name) ?? ParseDelay(name);
        error = profile is null
            ? $"There is no link profile '{name}'; there are {string.Join(", ", All.Select(known => known.Name))}, and {AnyDelay}."
            : null;
        return profile is not null;
    }

    private static LinkProfile? ParseDelay(string name)
    {
        if (name.Length <= DelayPrefix.Length + DelaySuffix.Length
            || !name.StartsWith(DelayPrefix, StringComparison.Ordinal)
            || !name.EndsWith(DelaySuffix, StringComparison.Ordinal))
        {
            return null;
        }

        ReadOnlySpan<char> number = name.AsSpan(DelayPrefix.Length, name.Length - DelayPrefix.Length - DelaySuffix.Length);
        return double.TryParse(number, NumberStyles.AllowDecimalPoint, CultureInfo.InvariantCulture, out double milliseconds)
            && milliseconds is >= 0 and <= MaxPureDelay
                ? PureDelay(milliseconds)
                : null;
    }
}
