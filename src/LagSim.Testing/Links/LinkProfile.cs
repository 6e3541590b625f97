using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A named kind of connection between a player and the host: what it does each way, and how far the two clocks are apart.
/// </summary>
/// <remarks>Immutable, safe on any thread. <see cref="LinkProfiles"/> has those that the project reports on.</remarks>
public sealed class LinkProfile
{
    /// <summary>A profile that is the same both ways.</summary>
    /// <param name="name">Not empty; what errors and reports call it.</param>
    /// <param name="bothWays">What each direction does.</param>
    /// <param name="receiverClockOffset">See <see cref="ReceiverClockOffset"/>.</param>
    /// <exception cref="ArgumentException"><paramref name="name"/> is empty.</exception>
    public LinkProfile(string name, LinkLeg bothWays, SimDuration receiverClockOffset = default)
        : this(name, bothWays, bothWays, receiverClockOffset)
    {
    }

    /// <summary>A profile with its own values for each direction.</summary>
    /// <param name="name">Not empty; what errors and reports call it.</param>
    /// <param name="toHost">What happens on the way up, from a player to the host.</param>
    /// <param name="fromHost">What happens on the way down, from the host to a player.</param>
    /// <param name="receiverClockOffset">See <see cref="ReceiverClockOffset"/>.</param>
    /// <exception cref="ArgumentException"><paramref name="name"/> is empty.</exception>
    public LinkProfile(string name, LinkLeg toHost, LinkLeg fromHost, SimDuration receiverClockOffset = default)
    {
        ArgumentException.ThrowIfNullOrEmpty(name);
        ArgumentNullException.ThrowIfNull(toHost);
        ArgumentNullException.ThrowIfNull(fromHost);
        Name = name;
        ToHost = toHost;
        FromHost = fromHost;
        ReceiverClockOffset = receiverClockOffset;
    }

    /// <summary>What errors and reports call it.</summary>
    public string Name { get; }

    /// <summary>The way up, from a player to the host.</summary>
    public LinkLeg ToHost { get; }

    /// <summary>The way down, from the host to a player.</summary>
    public LinkLeg FromHost { get; }

    /// <summary>
    /// How far a player's clock is ahead of the host's, on top of whatever else sets them apart. The link does nothing with it: who sets up
    /// the machines gives the player's a clock that far off.
    /// </summary>
    public SimDuration ReceiverClockOffset { get; }

    /// <summary>
    ///  Whether a bulk TCP transfer towards the player goes through the same queues as all else, its acknowledgements the other way;
    /// default false. <see cref="VirtualNetwork"/> runs one for each link of such a profile by itself.
    /// </summary>
    /// <exception cref="ArgumentException">
    /// The way down has no <see cref="LinkLeg.Bottleneck"/>: nothing would hold the transfer back.
    /// </exception>
    public bool HasBulkTransfer
    {
        get;
        init => field = !value || FromHost.Bottleneck is not null
            ? value
            : throw new ArgumentException($"A bulk transfer over '{Name}' needs a bottleneck on the way down; nothing else would hold it back.", nameof(value));
    }

    /// <summary>The usual round trip in milliseconds: the sum of the two delays, without what varies.</summary>
    public double RoundTripMilliseconds => ToHost.DelayMilliseconds + FromHost.DelayMilliseconds;

    /// <summary>The name.</summary>
    public override string ToString() => Name;
}
