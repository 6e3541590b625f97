using LagSim.Events;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>One peer of a drawn session.</summary>
/// <param name="Link">The link to the host; without meaning for the host itself.</param>
/// <param name="ClockPartsPerMillion">How much faster than true time the clock runs, in parts per million.</param>
/// <param name="ClockOffsetSeconds">How far the clock is ahead, in seconds.</param>
/// <param name="AsksAtSeconds">The time at which it asks to join, from the session's start; null for before the start, which waits for
/// it.</param>
/// <param name="LeavesAtSeconds">The time at which it leaves; null for not before the end.</param>
/// <param name="IsKilled">Whether it vanishes without a goodbye: from then on no datagram passes in either direction.</param>
internal sealed record CheckPlayer(
    LinkProfile Link, double ClockPartsPerMillion, double ClockOffsetSeconds, double? AsksAtSeconds, double? LeavesAtSeconds, bool IsKilled)
{
    /// <summary>The time at which its process stalls, from the session's start, and for how long; null for never.</summary>
    public (double AtSeconds, double Seconds)? Stop { get; init; }

    /// <summary>Whether it keeps its place when it leaves in good order, so that it may come back.</summary>
    public bool KeepsPlace { get; init; }

    /// <summary>The player, by index, that has left and comes back as this one, from another address; null for a player that was not there before.</summary>
    public int? Returns { get; init; }

    /// <summary>The index under which its actions were drawn, given its own.</summary>
    public int Person(int own) => Returns ?? own;

    /// <summary>Whether it comes back with the pass that it had. Without one it is another person.</summary>
    public bool HasPass { get; init; }

    /// <summary>What it calls itself.</summary>
    public string Name { get; init; } = "";

    /// <summary>As what it takes part.</summary>
    public PeerRole Role { get; init; } = PeerRole.Player;

    /// <summary>
    /// The number of bodies above which its world uses neighbour lists; null for the default, 64. The reference uses none, so that whatever
    /// they overlook is found.
    /// </summary>
    public int? IndexAbove { get; init; }
}
