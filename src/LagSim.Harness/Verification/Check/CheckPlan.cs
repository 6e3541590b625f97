using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Check;

/// <summary>Builds the schedule of a seeded session.</summary>
internal static class CheckPlan
{
    /// <summary>Returns everything that happens from the session's start on, in order.</summary>
    internal static IReadOnlyList<CheckStep> Of(CheckCase drawn)
    {
        List<CheckStep> plan = [];
        for (int peer = 1; peer < drawn.Players.Count; peer++)
        {
            CheckPlayer player = drawn.Players[peer];
            if (player.AsksAtSeconds is double asks)
            {
                plan.Add(new CheckStep(asks, CheckStepKind.Ask, peer));
            }

            if (player.LeavesAtSeconds is double leaves)
            {
                plan.Add(new CheckStep(leaves, CheckStepKind.Leave, peer));
            }
        }

        for (int peer = 0; peer < drawn.Players.Count; peer++)
        {
            if (drawn.Players[peer].Stop is (double at, double seconds))
            {
                plan.Add(new CheckStep(at, CheckStepKind.Stop, peer));
                plan.Add(new CheckStep(at + seconds, CheckStepKind.GoOn, peer));
            }
        }

        plan.AddRange(drawn.ActionIndices.Select(index => new CheckStep(drawn.Actions[index].AtSeconds, CheckStepKind.Act, index)));
        plan.Add(new CheckStep(CheckCase.Length, CheckStepKind.End, 0));
        return [.. plan.OrderBy(step => step.AtSeconds)]; // stable: actions of one instant stay in the order drawn
    }
}
