using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Check;

/// <summary>The results of all sessions.</summary>
/// <param name="Outcomes">The outcomes, in order of the seeds; fewer than requested if the check was stopped early.</param>
/// <param name="Failures">The failed sessions; the first few of them shrunk.</param>
/// <param name="AskedFor">The number of sessions requested.</param>
/// <param name="WallSeconds">The time taken, in seconds, without the shrinking.</param>
public sealed record CheckReport(IReadOnlyList<CheckOutcome> Outcomes, IReadOnlyList<CheckFailure> Failures, int AskedFor, double WallSeconds)
{
    /// <summary>
    /// The seeds of the sessions that were unfinished when the check was stopped, ascending. They have no outcome.
    /// </summary>
    public IReadOnlyList<ulong> StoppedSeeds { get; init; } = [];

    /// <summary>The seeds of the sessions that would have taken more events than they may, ascending.</summary>
    public IEnumerable<ulong> UnfinishedSeeds => Outcomes.Where(o => o.IsUnfinished).Select(o => o.Seed);

    /// <summary>Whether the check was stopped before all sessions were done.</summary>
    public bool IsStopped => Outcomes.Count < AskedFor;

    /// <summary>The number of events in all worlds, re-simulated ones included.</summary>
    public long Events => Outcomes.Sum(o => o.Events);

    /// <summary>The number of accepted events of players.</summary>
    public long ExternalEvents => Outcomes.Sum(o => o.ExternalEvents);

    /// <summary>How often an accepted event reached another peer after its stamp.</summary>
    public long LateEvents => Outcomes.Sum(o => o.LateEvents);

    /// <summary>How often a world rewound for such events.</summary>
    public long Heals => Outcomes.Sum(o => o.Heals);

    /// <summary>The number of heals that removed or added an impact.</summary>
    public long HealsThatChangedAnImpact => Outcomes.Sum(o => o.HealsThatChangedAnImpact);

    /// <summary>
    /// The number of events of players that were too late. Each is a failure, unless links were full or processes stalled and the host
    /// refused it.
    /// </summary>
    public long TooLateEvents => Outcomes.Sum(o => o.TooLateEvents);

    /// <summary>The number of accepted events that another peer lacks. Each is a failure.</summary>
    public long LostEvents => Outcomes.Sum(o => o.LostEvents);

    /// <summary>The number of states, hashes and timeline entries that differ in any bit.</summary>
    public long DifferingBits => Outcomes.Sum(o => o.DifferingBits);

    /// <summary>Returns the number of sessions with a rare feature.</summary>
    /// <param name="what">Selects the feature.</param>
    public int SessionsThatMet(Func<SceneFeatures, bool> what) => Outcomes.Count(o => what(o.Met));
}
