using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Makes the calls of rules, or finds that one made before stands.</summary>
internal class RuleCaller
{
    /// <summary>How many rounds of one tick rules may cause: 64. What bounces between rules and itself needs a few.</summary>
    internal const int MaxRounds = 64;

    /// <summary>How many acts rules may make in one tick: as many as calls for all timers that may be set can make, 16,384. Where each act
    /// brings a call that acts twice, their number doubles in a round, and <see cref="MaxRounds"/> is never reached.</summary>
    internal const int MaxActsATick = RuleWorld.MaxTimers * RuleWorld.MaxActs;

    /// <summary>How many calls may lie within the history: 262,144, some 100 MB. What goes on for ever from tick to tick ends
    /// there.</summary>
    internal const int MaxCalls = 1 << 18;

    /// <summary>How many bytes the states after the calls within the history may take: 2^28. A state of three kilobytes, such as that of a
    /// hundred bodies, may so change 80,000 times within it, and one of the largest size 240 times.</summary>
    internal const long MaxStateBytes = 1L << 28;

    private readonly GameRules rules;
    private readonly RuleLog log;
    private readonly RuleMemory memory;
    private readonly RuleWorld world;
    private readonly RuleView view;
    private readonly RuleActs acts;
    private readonly HealingMode mode;
    private readonly List<RuleRead> spare = new();
    private readonly RunningRuleCall? running;
    private StateVersion? loaded; // what the memory holds

    /// <summary>Calls these rules in one world.</summary>
    internal RuleCaller(
        GameRules rules, RuleLog log, RuleMemory memory, RuleWorld world, RuleView view, RuleActs acts, HealingMode mode)
    {
        this.rules = rules;
        this.log = log;
        this.memory = memory;
        this.world = world;
        this.view = view;
        this.acts = acts;
        this.mode = mode;
        running = log.Running;
    }

    /// <summary>How many calls were made, those made again included.</summary>
    internal long Made { get; private set; }

    /// <summary>Forgets calls before a time, which can no longer change.</summary>
    internal void DropBefore(SimTime edge) => log.DropBefore(edge);

    /// <summary>Deals with the call that is next. What follows from it is scheduled.</summary>
    /// <exception cref="InstantException">The rules failed.</exception>
    internal void Process()
    {
        RuleCall call = log.Next();
        if (call.IsGone)
        {
            if (call.Acts.Count > 0)
            {
                TakeBackLater(call);
            }

            TakeBack(call);
            log.Drop();
            acts.Follow();
            return;
        }

        FindBefore(call, out uint first, out int acted, out int rounds);
        if (Stands(call, first))
        {
            log.Stand();
            return;
        }

        ThrowIfTooMany(call);

        Make(call, first);
        if (world.Chains && rounds >= MaxRounds)
        {
            throw Failed(call, $"caused more than {MaxRounds} rounds of events in one tick", null);
        }

        if (acted + world.Acts.Count > MaxActsATick)
        {
            throw Failed(call, $"did more than {MaxActsATick} things to bodies in one tick", null);
        }

        if (first + world.Acts.Count != call.FirstAct + call.Acts.Count)
        {
            TakeBackLater(call);
        }

        acts.Exchange(call, world.Acts);
        call.FirstAct = first;
        call.Chains = world.Chains;
        Copy(world.Reads, call.Reads);
        if (call.Notices.Count + world.Notices.Count > 0)
        {
            log.NoteNotices(call.Key);
            Copy(world.Notices, call.Notices);
        }

        log.Stand(memory.Encode());
        loaded = log.Current;
        acts.Follow();
    }

    /// <summary>Whether a call that was made before would be made with the same, and so do the same.</summary>
    private bool Stands(RuleCall call, uint first) =>
        call.IsMade && mode != HealingMode.FullRollback && call.FirstAct == first && HasStateBefore(call) && ReadsTheSame(call);

    /// <summary>Whether the state before a call is the one that it was made with.</summary>
    private protected virtual bool HasStateBefore(RuleCall call) => call.Before!.IsSameAs(log.Current);

    /// <summary>Takes back what a call did that is made no more.</summary>
    private protected virtual void TakeBack(RuleCall call) => acts.TakeBack(call);

    /// <summary>Whether a call would read what it read.</summary>
    private protected virtual bool ReadsTheSame(RuleCall call) => view.IsUnchanged(call.Reads, call.Key, spare);

    /// <summary>
    /// What a call does is numbered after what others of its tick and round do before it. Where their number changes, all later ones are
    /// taken back first, so that no act ever has the number of another.
    /// </summary>
    private void TakeBackLater(RuleCall than)
    {
        for (int n = log.Position + 1; n < log.Count && log[n].Key.Time == than.Key.Time && log[n].Key.Round == than.Key.Round; n++)
        {
            acts.TakeBack(log[n]);
            log[n].IsMade = false;
        }
    }

    private static void Copy<T>(List<T> from, List<T> to)
    {
        to.Clear();
        to.AddRange(from);
    }

    private void Make(RuleCall call, uint first)
    {
        Load();
        world.Begin(call, first);
        loaded = null; // until it is known what the call leaves
        Made++;
        running?.Begin(world.Scene, RuleCallText.Method(call.Key.Kind), call.Key, call.Trigger);
        try
        {
            Dispatch(call);
        }
        catch (Exception failure)
        {
            throw Failed(call, failure.Message, failure);
        }
        finally
        {
            world.End();
            running?.End(); // throws if the call was given up, whatever came of it
        }
    }

    private void Dispatch(RuleCall call)
    {
        switch (call.Key.Kind)
        {
            case EventKind.Start:
                rules.OnStart(world);
                break;
            case EventKind.Command:
                rules.OnCommand(world, call.Key.Peer, call.Trigger.Command!);
                break;
            case EventKind.Timer:
                memory.Cancel(unchecked((int)call.Key.Sequence));
                rules.OnTimer(world, unchecked((int)call.Key.Sequence));
                break;
            case EventKind.Impact:
                rules.OnContact(world, new RuleContact(call.Trigger.Contact));
                break;
            case EventKind.Crossing:
                rules.OnCrossing(world, new Crossing(call.Key, call.Trigger.Entered));
                break;
            case EventKind.Spawn when rules.HearsBodies:
                rules.OnSpawned(world, call.Key.Body);
                break;
            case EventKind.Remove when rules.HearsBodies:
                rules.OnRemoved(world, call.Key.Body);
                memory.Forget(call.Key.Body);
                break;
            case EventKind.Lost when rules.HearsBodies:
                rules.OnLost(world, call.Key.Body, (LossReason)call.Key.Sequence);
                memory.Forget(call.Key.Body);
                break;
            default:
                memory.Forget(call.Key.Body); // a body that is spawned begins without a state, and one that is removed has none
                break;
        }
    }

    /// <summary>Calls, and the states after them, are kept for the history; what goes on for ever ends here rather than with the
    /// memory.</summary>
    private void ThrowIfTooMany(RuleCall call)
    {
        if (log.Position < MaxCalls && log.StateBytes <= MaxStateBytes)
        {
            return;
        }

        log.DropAllBefore(view.HistoryEdge);
        if (log.Position >= MaxCalls)
        {
            throw Failed(call, $"it is one more than the {MaxCalls} that may lie within the history", null);
        }

        if (log.StateBytes > MaxStateBytes)
        {
            throw Failed(
                call, $"the states after the {log.Position} calls within the history take {log.StateBytes} bytes, more than {MaxStateBytes}:"
                    + " each that changes something is kept as a copy of all", null);
        }
    }

    private void Load()
    {
        if (!ReferenceEquals(loaded, log.Current))
        {
            memory.Load(log.Current.Bytes);
        }
    }

    /// <summary>What calls before the next one have done at its tick.</summary>
    /// <param name="call">The next call.</param>
    /// <param name="first">The number of its first act: how many acts there are of its tick and round.</param>
    /// <param name="acted">How many acts there are of its tick.</param>
    /// <param name="rounds">How many rounds rules have caused at it.</param>
    private void FindBefore(RuleCall call, out uint first, out int acted, out int rounds)
    {
        first = 0;
        acted = 0;
        rounds = 0;
        uint round = uint.MaxValue;
        for (int n = log.Position - 1; n >= 0 && log[n].Key.Time == call.Key.Time; n--)
        {
            RuleCall before = log[n];
            first += before.Key.Round == call.Key.Round ? (uint)before.Acts.Count : 0;
            acted += before.Acts.Count;
            if (before.Chains && before.Key.Round != round)
            {
                round = before.Key.Round;
                rounds++;
            }
        }
    }

    private InstantException Failed(RuleCall call, string why, Exception? cause) =>
        new($"{RuleCallText.Failed(world.Scene, RuleCallText.Method(call.Key.Kind), call.Key, call.Trigger)}: {why}", call.Key.Time, cause);
}
