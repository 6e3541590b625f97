using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim;

/// <summary>What is to happen next: the least of the bodies' pending events and the calls of rules.</summary>
/// <remarks>At one key the event of a body comes first: rules are called right after the event that they hear of.</remarks>
internal sealed class Agenda(EventScheduler scheduler, RuleLog? rules)
{
    /// <summary>The slot that stands for the rules.</summary>
    internal const int Rules = -1;

    /// <summary>When the next comes; the latest time there is if nothing does.</summary>
    internal SimTime NextTime => TryGetLeast(out _, out EventKey key) ? key.Time : SimTime.MaxValue;

    /// <summary>The least that is pending, and of whose slot it is; false if nothing is.</summary>
    internal bool TryGetLeast(out int slot, out EventKey key)
    {
        bool isPending = scheduler.TryGetLeast(out slot, out key);
        if (rules is null || !rules.TryGetNext(out EventKey call) || (isPending && EventKey.Compare(call, key) >= 0))
        {
            return isPending;
        }

        slot = Rules;
        key = call;
        return true;
    }
}
