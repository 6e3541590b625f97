using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim;

/// <summary>Compares the calls of rules in two worlds: what they did and told, and the state after each, to the bit.</summary>
internal static class RuleComparison
{
    /// <summary>Returns the first difference, with both versions of it; null if there is none. History that either world has forgotten is
    /// not compared.</summary>
    internal static string? FirstDifference(Engine expected, Engine actual)
    {
        if (expected.Rules is not RuleLog a || actual.Rules is not RuleLog b)
        {
            return null;
        }

        EventKey edge = EventKey.Before(SimTime.Max(expected.Progress.HistoryEdge, actual.Progress.HistoryEdge));
        int x = a.FirstFrom(edge);
        int y = b.FirstFrom(edge);
        for (; x < a.Position || y < b.Position; x++, y++)
        {
            RuleCall? one = x < a.Position ? a[x] : null;
            RuleCall? other = y < b.Position ? b[y] : null;
            if (one is null || other is null || !IsSame(one, other))
            {
                return $"Rules '{expected.Scene.Rules}': expected {Describe(one)}, got {Describe(other)}.";
            }
        }

        return a.Current.IsSameAs(b.Current) ? null : $"Rules '{expected.Scene.Rules}': the states differ, and no call that is kept does.";
    }

    private static bool IsSame(RuleCall a, RuleCall b)
    {
        bool isSame = a.Key == b.Key && a.Trigger.IsSameAs(b.Trigger) && a.StateAfter!.IsSameAs(b.StateAfter!)
            && a.Acts.Count == b.Acts.Count && a.Notices.Count == b.Notices.Count;
        for (int n = 0; isSame && n < a.Acts.Count; n++)
        {
            isSame = a.Acts[n].IsSameAs(b.Acts[n]);
        }

        for (int n = 0; isSame && n < a.Notices.Count; n++)
        {
            isSame = a.Notices[n] == b.Notices[n];
        }

        return isSame;
    }

    private static string Describe(RuleCall? call) => call is null ? "no more call" : FormattableString.Invariant(
        $"a call for {call.Key} with {call.Acts.Count} acts, {call.Notices.Count} notices and a state of hash {Hash(call):x16} after it");

    private static ulong Hash(RuleCall call)
    {
        Scenes.StableHash hash = default;
        StateLayout.AddTo(ref hash, call.StateAfter!.Bytes);
        return hash.Value;
    }
}
