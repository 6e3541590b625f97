using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Check;

/// <summary>What all sessions came to.</summary>
/// <param name="Outcomes">One a session, by ascending seed; fewer than were asked for if the check was stopped early.</param>
/// <param name="Failures">Those that failed; the first few of them shrunk.</param>
/// <param name="AskedFor">How many sessions were to be played.</param>
/// <param name="WallSeconds">How long it took, without the shrinking.</param>
public sealed record CheckReport(IReadOnlyList<CheckOutcome> Outcomes, IReadOnlyList<CheckFailure> Failures, int AskedFor, double WallSeconds)
{
    /// <summary>
    /// The seeds of the sessions that were given up in the middle because the check was stopped, ascending; they have no outcome.
    /// </summary>
    public IReadOnlyList<ulong> StoppedSeeds { get; init; } = [];

    /// <summary>Whether it was stopped before all sessions were done.</summary>
    public bool IsStopped => Outcomes.Count < AskedFor;

    /// <summary>Events that all worlds ran, those run again included.</summary>
    public long Events => Outcomes.Sum(o => o.Events);

    /// <summary>Accepted events of players.</summary>
    public long ExternalEvents => Outcomes.Sum(o => o.ExternalEvents);

    /// <summary>How often such an event came to another peer after its stamp.</summary>
    public long LateEvents => Outcomes.Sum(o => o.LateEvents);

    /// <summary>How often a world rewrote its past for such events.</summary>
    public long Heals => Outcomes.Sum(o => o.Heals);

    /// <summary>How many of these cut off or put in an impact.</summary>
    public long HealsThatChangedAnImpact => Outcomes.Sum(o => o.HealsThatChangedAnImpact);

    /// <summary>
    /// Events of players that were too late; each is a failure, unless links were full or processes stood still and the host refused it.
    /// </summary>
    public long TooLateEvents => Outcomes.Sum(o => o.TooLateEvents);

    /// <summary>Events that the host accepted and that another peer lacks; each is a failure.</summary>
    public long LostEvents => Outcomes.Sum(o => o.LostEvents);

    /// <summary>States, hashes and timeline entries that differ in any bit.</summary>
    public long DifferingBits => Outcomes.Sum(o => o.DifferingBits);

    /// <summary>How many sessions met something rare.</summary>
    /// <param name="what">Tells it from all that was met.</param>
    public int SessionsThatMet(Func<SceneFeatures, bool> what) => Outcomes.Count(o => what(o.Met));
}
