using System.Collections.Generic;
using LagSim.Testing;

namespace LagSim.Harness.Verification.Check;

/// <summary>What one session came to.</summary>
public sealed record CheckOutcome
{
    /// <summary>What it was drawn by.</summary>
    public required ulong Seed { get; init; }

    /// <summary>How many peers took part, those that left or came later included.</summary>
    public int Peers { get; init; }

    /// <summary>Events that all worlds ran, those run again included.</summary>
    public long Events { get; init; }

    /// <summary>Accepted events of players.</summary>
    public long ExternalEvents { get; init; }

    /// <summary>How many of them have the stamp of another, to the tick.</summary>
    public int TiedEvents { get; init; }

    /// <summary>How often such an event came to another peer after its stamp.</summary>
    public long LateEvents { get; init; }

    /// <summary>How often a world rewrote its past for such events.</summary>
    public long Heals { get; init; }

    /// <summary>How many of these cut off or put in an impact; see <see cref="HealImpacts"/>.</summary>
    public long HealsThatChangedAnImpact { get; init; }

    /// <summary>Events that heals ran again.</summary>
    public long EventsRerun { get; init; }

    /// <summary>Impacts in the world of the peer that never had a delay.</summary>
    public long Impacts { get; init; }

    /// <summary>What of rare things it met.</summary>
    public SceneFeatures Met { get; init; }

    /// <summary>Events that were refused for being too late, or came to a peer whose history no longer had their time.</summary>
    public long TooLateEvents { get; init; }

    /// <summary>
    /// Of these, those that the host accepted: they came to another peer neither in time, nor in a copy of the world. There must be none.
    /// </summary>
    public long LostEvents { get; init; }

    /// <summary>Whether links had rates and queues; then the host may refuse what came too late.</summary>
    public bool HasFullLinks { get; init; }

    /// <summary>Whether a process stood still for a time; likewise.</summary>
    public bool HasStops { get; init; }

    /// <summary>How often a peer that could not follow got a fresh copy of the world.</summary>
    public long Copies { get; init; }

    /// <summary>Events that the host refused for another reason.</summary>
    public long RefusedEvents { get; init; }

    /// <summary>Peers that came in after the start.</summary>
    public int LateClients { get; init; }

    /// <summary>Peers that left or vanished.</summary>
    public int Leavers { get; init; }

    /// <summary>States, hashes and timeline entries that were compared.</summary>
    public long Compared { get; init; }

    /// <summary>Of these, how many differ in any bit.</summary>
    public long DifferingBits { get; init; }

    /// <summary>What went wrong, as a sentence; null if nothing did.</summary>
    public string? Failure { get; init; }

    /// <summary>The first event that differs, if one does.</summary>
    public FirstDifference? Difference { get; init; }

    /// <summary>What of it was played: the scene's bodies by index.</summary>
    public IReadOnlyList<int> Bodies { get; init; } = [];

    /// <summary>What of it was played: what was to be done, by index.</summary>
    public IReadOnlyList<int> Actions { get; init; } = [];
}
