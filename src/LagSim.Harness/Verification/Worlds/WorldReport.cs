using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>The results of all worlds.</summary>
/// <param name="Outcomes">The outcomes, in order of the seeds; fewer than requested if the check was stopped early.</param>
/// <param name="AskedFor">The number of worlds requested.</param>
/// <param name="WallSeconds">The time taken, in seconds.</param>
public sealed record WorldReport(IReadOnlyList<WorldOutcome> Outcomes, int AskedFor, double WallSeconds)
{
    /// <summary>The worlds that failed.</summary>
    public IReadOnlyList<WorldOutcome> Failures => [.. Outcomes.Where(o => o.FailureKind != WorldFailureKind.None)];

    /// <summary>Whether it was stopped before all worlds were done.</summary>
    public bool IsStopped => Outcomes.Count < AskedFor;

    /// <summary>The number of worlds that failed in a way.</summary>
    public int CountOf(WorldFailureKind kind) => Outcomes.Count(o => o.FailureKind == kind);
}
