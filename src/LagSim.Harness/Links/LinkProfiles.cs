using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Globalization;
using System.Linq;

namespace LagSim.Harness.Links;

/// <summary>The link profiles that the project reports on, by name.</summary>
/// <remarks>All are one hop between a player and the host. Immutable, safe on any thread.</remarks>
public static class LinkProfiles
{
    /// <summary>The longest pure delay, in milliseconds.</summary>
    public const double MaxPureDelay = 2_000;

    private const string DelayPrefix = "delay-";
    private const string DelaySuffix = "ms";

    private static readonly double[] LadderSteps = [0, 10, 20, 50, 100, 200, 500, 1000, 2000];

    /// <summary>Two processes on one machine: 0.05 ms, jitter 0.01 ms.</summary>
    public static LinkProfile Loopback { get; } = new("loopback", new LinkLeg(0.05, 0.01));

    /// <summary>Two machines on one wired network: 0.3 ms, jitter 0.05 ms.</summary>
    public static LinkProfile Lan { get; } = new("lan", new LinkLeg(0.3, 0.05));

    /// <summary>Everything at once, to break things with: 200 ms, jitter 60 ms, 10 % lost in bursts of 5, 5 % reordered, 2 % duplicated.</summary>
    public static LinkProfile Awful { get; } =
        new("awful", new LinkLeg(200, 60, lossPercent: 10, meanBurstLength: 5, reorderPercent: 5, duplicatePercent: 2));

    /// <summary>Pure delays from nothing to 2 s: 0, 10, 20, 50, 100, 200, 500, 1000, 2000 ms one way.</summary>
    public static IReadOnlyList<LinkProfile> Ladder { get; } = Array.ConvertAll(LadderSteps, PureDelay);

    /// <summary>Every profile with a name of its own, the ladder last.</summary>
    public static IReadOnlyList<LinkProfile> All { get; } = [Loopback, Lan, Awful, .. Ladder];

    /// <summary>A link that delays every datagram by the same time each way and does nothing else, named <c>delay-25ms</c> for 25.</summary>
    /// <param name="milliseconds">One way, 0 to <see cref="MaxPureDelay"/>; rounded to a nanosecond, so that the name says all.</param>
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

    /// <summary>The profile of that name: one of <see cref="All"/>, or any <c>delay-Nms</c>.</summary>
    /// <param name="name">Case matters.</param>
    /// <param name="profile">The profile, if there is one.</param>
    /// <param name="error">Else a sentence that says what there is.</param>
    public static bool TryGet(
        string name, [NotNullWhen(true)] out LinkProfile? profile, [NotNullWhen(false)] out string? error)
    {
        ArgumentNullException.ThrowIfNull(name);
        profile = All.FirstOrDefault(known => known.Name == name) ?? ParseDelay(name);
        error = profile is null
            ? $"There is no link profile '{name}'; there are {string.Join(", ", All.Select(known => known.Name))}, "
                + $"and delay-Nms for any N from 0 to {MaxPureDelay}."
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
