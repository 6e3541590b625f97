using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Tests.Faults;

/// <summary>What a world with rules can do wrong when it heals.</summary>
[Flags]
internal enum RuleFault
{
    None = 0,

    /// <summary>Calls stand from where paths have reconverged, whatever the state of the rules is.</summary>
    StopsTooEarly = 1,

    /// <summary>What a call did that does not happen any more stays.</summary>
    LeavesActs = 2,

    /// <summary>What a call read of the world is not noted.</summary>
    ForgetsReads = 4,

    /// <summary>A call stands though the state before it is another.</summary>
    IgnoresState = 8,

    /// <summary>A call stands whatever calls before it did at its tick.</summary>
    IgnoresTally = 16,

    /// <summary>Of a failed command that counts as none, what it did before it failed stays.</summary>
    KeepsFailed = 32,

    /// <summary>What is said of a player is heard after all that was heard when it came, whatever its time.</summary>
    OrdersPlayersByArrival = 64,
}

/// <summary>Makes the parts of a world with faulty rules.</summary>
internal sealed class FaultyRules(RuleFault fault) : EngineParts
{
    internal override RuleLog RuleLog(Scene scene, SimTime start, ReadOnlySpan<byte> state) => new Log(scene, start, state, fault);

    internal override RuleCaller RuleCaller(
        GameRules rules, RuleLog log, RuleMemory memory, RuleWorld world, RuleView view, RuleActs acts, HealingMode mode) =>
        new Caller(rules, log, memory, world, view, acts, mode, fault);

    private sealed class Log(Scene scene, SimTime start, ReadOnlySpan<byte> state, RuleFault fault) : RuleLog(scene, start, state)
    {
        internal override void Add(in EventKey key, in RuleTrigger trigger)
        {
            bool isAfterAll = fault.HasFlag(RuleFault.OrdersPlayersByArrival) && key.Kind == EventKind.Player && Count > 0 && this[Count - 1].Key.Time > key.Time;
            base.Add(
                isAfterAll ? new EventKey(this[Count - 1].Key.Time + SimDuration.OneTick, key.Round, key.Kind, key.Body, key.Other, key.Peer, key.Sequence) : key,
                trigger);
        }

        internal override bool HaveReconverged() => fault.HasFlag(RuleFault.StopsTooEarly) || base.HaveReconverged();
    }

    private sealed class Caller(
        GameRules rules, RuleLog log, RuleMemory memory, RuleWorld world, RuleView view, RuleActs acts, HealingMode mode, RuleFault fault)
        : RuleCaller(rules, log, memory, world, view, acts, mode)
    {
        private protected override bool HasStateBefore(RuleCall call) => fault.HasFlag(RuleFault.IgnoresState) || base.HasStateBefore(call);

        private protected override bool HasTallyBefore(RuleCall call) => fault.HasFlag(RuleFault.IgnoresTally) || base.HasTallyBefore(call);

        private protected override void Skip(RuleCall call, Exception failure)
        {
            if (!fault.HasFlag(RuleFault.KeepsFailed))
            {
                base.Skip(call, failure);
            }
        }

        private protected override bool ReadsTheSame(RuleCall call) => fault.HasFlag(RuleFault.ForgetsReads) || base.ReadsTheSame(call);

        private protected override void TakeBack(RuleCall call)
        {
            if (!fault.HasFlag(RuleFault.LeavesActs))
            {
                base.TakeBack(call);
            }
        }
    }
}
