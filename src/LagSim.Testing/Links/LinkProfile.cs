using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A named kind of connection between a player and the host: the effect of each direction, and the offset of the two clocks.
/// </summary>
/// <remarks>Immutable, safe on any thread. <see cref="LinkProfiles"/> lists those that the project reports on.</remarks>
public sealed class LinkProfile
{
    /// <summary>Creates a profile that is the same in both directions.</summary>
    /// <param name="name">The name in errors and reports; not empty.</param>
    /// <param name="bothWays">The properties of each direction.</param>
    /// <param name="receiverClockOffset">See <see cref="ReceiverClockOffset"/>.</param>
    /// <exception cref="ArgumentException"><paramref name="name"/> is empty.</exception>
    public LinkProfile(string name, LinkLeg bothWays, SimDuration receiverClockOffset = default)
        : this(name, bothWays, bothWays, receiverClockOffset)
    {
    }

    /// <summary>Creates a profile with separate properties for each direction.</summary>
    /// <param name="name">The name in errors and reports; not empty.</param>
    /// <param name="toHost">The direction from a player up to the host.</param>
    /// <param name="fromHost">The direction from the host down to a player.</param>
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

    /// <summary>The name in errors and reports.</summary>
    public string Name { get; }

    /// <summary>The direction from a player up to the host.</summary>
    public LinkLeg ToHost { get; }

    /// <summary>The direction from the host down to a player.</summary>
    public LinkLeg FromHost { get; }

    /// <summary>
    /// How far a player's clock is ahead of the host's, besides any other offset. The link ignores it: the code that sets up the machines
    /// gives the player's a clock with that offset.
    /// </summary>
    public SimDuration ReceiverClockOffset { get; }

    /// <summary>
    /// Whether a bulk TCP transfer towards the player shares its queues, with its acknowledgements in the other direction; default false.
    /// <see cref="VirtualNetwork"/> runs one by itself for each link with such a profile.
    /// </summary>
    /// <exception cref="ArgumentException">
    /// The direction to the player has no <see cref="LinkLeg.Bottleneck"/>, so nothing would limit the transfer.
    /// </exception>
    public bool HasBulkTransfer
    {
        get;
        init => field = !value || FromHost.Bottleneck is not null
            ? value
            : throw new ArgumentException($"A bulk transfer over '{Name}' needs a bottleneck on the way down; nothing else would hold it back.", nameof(value));
    }

    /// <summary>The usual round trip in milliseconds: the sum of the two delays, without variation.</summary>
    public double RoundTripMilliseconds => ToHost.DelayMilliseconds + FromHost.DelayMilliseconds;

    /// <summary>The name.</summary>
    public override string ToString() => Name;
}
