using System;
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
