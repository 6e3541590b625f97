using System.Collections.Generic;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>The link between each client of a playground and its host, as a person sets it.</summary>
/// <remarks>Immutable.</remarks>
internal sealed record LinkSettings
{
    /// <summary>The name of a link that a person has set by hand.</summary>
    internal const string Custom = "custom";

    /// <summary>All names that a link may have.</summary>
    internal static IReadOnlyList<string> Names { get; } = [Custom, .. LinkProfiles.Names];

    /// <summary>The name of a profile, or <see cref="Custom"/>: then the numbers below count.</summary>
    internal string Profile { get; init; } = Custom;

    /// <summary>The delay one way, in milliseconds, 0 to 2,000.</summary>
    internal double DelayMilliseconds { get; init; } = 100;

    /// <summary>The standard deviation of the delay, in milliseconds, 0 to 500.</summary>
    internal double JitterMilliseconds { get; init; }

    /// <summary>How many datagrams of a hundred are lost, 0 to 50.</summary>
    internal double LossPercent { get; init; }

    /// <summary>The mean number of datagrams that are lost in a row, 1 to 20.</summary>
    internal double MeanBurstLength { get; init; } = 1;

    /// <summary>How much longer the way to the host takes than the way back, in milliseconds; at most twice the delay, either way.</summary>
    internal double AsymmetryMilliseconds { get; init; }

    /// <summary>How far the clocks of clients are ahead of the host's, in milliseconds, up to ten seconds either way.</summary>
    internal double ClockOffsetMilliseconds { get; init; }

    /// <summary>Returns what the virtual network makes of it.</summary>
    internal LinkProfile ToProfile()
    {
        if (Profile != Custom)
        {
            return LinkProfiles.Get(Profile);
        }

        double apart = AsymmetryMilliseconds / 2;
        return new LinkProfile(
            Custom,
            toHost: new LinkLeg(DelayMilliseconds + apart, JitterMilliseconds, LossPercent, MeanBurstLength),
            fromHost: new LinkLeg(DelayMilliseconds - apart, JitterMilliseconds, LossPercent, MeanBurstLength),
            SimDuration.FromMilliseconds(ClockOffsetMilliseconds));
    }
}
