using System.Collections.Generic;
using LagSim.Testing;

namespace LagSim.Harness.Verification.Check;

/// <summary>The outcome of one session.</summary>
public sealed record CheckOutcome
{
    /// <summary>The seed.</summary>
    public required ulong Seed { get; init; }

    /// <summary>The number of peers, including those that left or joined later.</summary>
    public int Peers { get; init; }

    /// <summary>
    /// Whether it would have taken more events than it may (<see cref="CheckOptions.MaxEvents"/>), so that nothing was compared.
    /// </summary>
    public bool IsUnfinished { get; init; }

    /// <summary>The number of events in all worlds, re-simulated ones included.</summary>
    public long Events { get; init; }

    /// <summary>The number of accepted events of players.</summary>
    public long ExternalEvents { get; init; }

    /// <summary>The number of accepted events with the same stamp as another one, to the tick.</summary>
    public int TiedEvents { get; init; }

    /// <summary>How often an accepted event reached another peer after its stamp.</summary>
    public long LateEvents { get; init; }

    /// <summary>How often a world rewound for such events.</summary>
    public long Heals { get; init; }

    /// <summary>The number of heals that removed or added an impact; see <see cref="HealImpacts"/>.</summary>
    public long HealsThatChangedAnImpact { get; init; }

    /// <summary>The number of events that heals re-simulated.</summary>
    public long EventsRerun { get; init; }

    /// <summary>The number of impacts in the reference, which has all events on time.</summary>
    public long Impacts { get; init; }

    /// <summary>The rare features of the session.</summary>
    public SceneFeatures Met { get; init; }

    /// <summary>
    /// The number of events that were refused for being too late, or reached a peer whose history no longer had their time.
    /// </summary>
    public long TooLateEvents { get; init; }

    /// <summary>
    /// Of these, the number that the host accepted: they reached another peer neither in time, nor in a snapshot. There must be none.
    /// </summary>
    public long LostEvents { get; init; }

    /// <summary>Whether links had rates and queues. The host may refuse events that arrive too late then.</summary>
    public bool HasFullLinks { get; init; }

    /// <summary>Whether a process stalled. The host may refuse events that arrive too late then.</summary>
    public bool HasStops { get; init; }

    /// <summary>How often a peer that could not follow got a fresh snapshot.</summary>
    public long Copies { get; init; }

    /// <summary>The number of events that the host refused for another reason.</summary>
    public long RefusedEvents { get; init; }

    /// <summary>The number of peers that joined after the start.</summary>
    public int LateClients { get; init; }

    /// <summary>The number of peers that left or vanished.</summary>
    public int Leavers { get; init; }

    /// <summary>The number of compared states, hashes and timeline entries.</summary>
    public long Compared { get; init; }

    /// <summary>The number of these that differ in any bit.</summary>
    public long DifferingBits { get; init; }

    /// <summary>The failure, as a sentence; null if there is none.</summary>
    public string? Failure { get; init; }

    /// <summary>The first event that differs; null if none does.</summary>
    public FirstDifference? Difference { get; init; }

    /// <summary>The scene's bodies that were played, by index.</summary>
    public IReadOnlyList<int> Bodies { get; init; } = [];

    /// <summary>The actions that were played, by index.</summary>
    public IReadOnlyList<int> Actions { get; init; } = [];
}
