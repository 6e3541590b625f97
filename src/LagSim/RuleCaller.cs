using System;
using System.Collections.Generic;
using System.Diagnostics;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Makes the calls of rules, or finds that one made before stands.</summary>
internal class RuleCaller
{
    /// <summary>How many calls may lie within the history: 262,144, some 100 MB. What goes on for ever from tick to tick ends
    /// there.</summary>
    internal const int MaxCalls = 1 << 18;

    /// <summary>
    /// How many bytes the states after the calls within the history may take: 2^28. A call that changes the state counts the pages that
    /// differ (<see cref="StatePage"/>), and a reference to each. So rules with states of a hundred bodies may change one of them 250,000
    /// times, and rules with the largest state 27,000 times.
    /// </summary>
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
    private bool hasTraced;

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

    /// <summary>What the call that was made last said that it costs.</summary>
    internal double Charged => world.Charged;

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

        call.Before = RuleTally.Before(call, log.Position > 0 ? log[log.Position - 1] : null);
        if (Stands(call))
        {
            log.Stand();
            return;
        }

        ThrowIfTooMany(call);
        Make(call);
        if (world.Deeds.All.Count != call.Acts.Count)
        {
            TakeBackLater(call);
        }

        acts.Exchange(call, world.Deeds.All);
        call.IsTakenBack = false;
        call.MadeAfter = call.Before;
        call.Chains = world.Deeds.Chains;
        call.Dropped = world.Deeds.Dropped;
        call.IsUnheard = IsUnheard(call);
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
    private bool Stands(RuleCall call) =>
        call.IsMade && mode != HealingMode.FullRollback && HasTallyBefore(call) && HasStateBefore(call) && ReadsTheSame(call);

    /// <summary>Whether what calls before it did at its tick leaves a call what it was made with.</summary>
    private protected virtual bool HasTallyBefore(RuleCall call) => call.Before.IsAsGoodAs(call.MadeAfter);

    /// <summary>Whether the state before a call is the one that it was made with.</summary>
    private protected virtual bool HasStateBefore(RuleCall call) => call.StateBefore!.IsSameAs(log.Current);

    /// <summary>Takes back what a call did that is made no more.</summary>
    private protected virtual void TakeBack(RuleCall call) => acts.TakeBack(call);

    /// <summary>Whether a call would read what it read.</summary>
    private protected virtual bool ReadsTheSame(RuleCall call) => view.IsUnchanged(call.Reads, call.Key, spare);

    /// <summary>
    /// What a call does is numbered after what others of its tick and round do before it. Where their number changes, all later ones are
    /// taken back first, so that no act ever has the number of another. Each is taken back once: after one that was, all are.
    /// </summary>
    private void TakeBackLater(RuleCall than)
    {
        if (than.IsTakenBack)
        {
            return;
        }

        for (int n = log.Position + 1; n < log.Count && log[n].Key.Time == than.Key.Time && log[n].Key.Round == than.Key.Round; n++)
        {
            acts.TakeBack(log[n]);
            log[n].IsMade = false;
            log[n].IsTakenBack = true;
        }
    }

    private static void Copy<T>(List<T> from, List<T> to)
    {
        to.Clear();
        to.AddRange(from);
    }

    private void Make(RuleCall call)
    {
        Load();
        world.Begin(call);
        loaded = null; // until it is known what the call leaves
        Made++;
        running?.Begin(world.Scene, RuleCallText.Method(call.Key.Kind), call.Key, call.Trigger);
        try
        {
            Dispatch(call);
            TellIfEnded(call);
        }
        catch (Exception failure) when (MaySkip(call, failure))
        {
            Skip(call, failure);
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
            case EventKind.Player:
                rules.OnPlayer(world, call.Trigger.Player!);
                break;
            case EventKind.Timer:
                memory.Cancel(unchecked((int)call.Key.Sequence));
                rules.OnTimer(world, unchecked((int)call.Key.Sequence));
                break;
            case EventKind.Impact or EventKind.Crossing when IsUnheard(call):
                world.Deeds.Drop();
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

    private static bool IsUnheard(RuleCall call) => call.Before.IsDeaf && call.Key.Kind is (EventKind.Impact or EventKind.Crossing);

    /// <summary>Calls, and the states after them, are kept for the history; what goes on for ever ends here rather than with the
    /// memory.</summary>
    private void ThrowIfTooMany(RuleCall call)
    {
        if (log.Heard < MaxCalls && log.StateBytes <= MaxStateBytes)
        {
            return;
        }

        log.DropAllBefore(view.HistoryEdge);
        if (log.Heard >= MaxCalls)
        {
            throw Failed(call, $"it is one more than the {MaxCalls} that may lie within the history", null);
        }

        if (log.StateBytes > MaxStateBytes)
        {
            throw Failed(
                call, $"the states after the {log.Heard} calls within the history take {log.StateBytes} bytes, more than {MaxStateBytes}:"
                    + $" of each that changes something the parts are kept that differ, by up to {StatePage.MostBytes} bytes", null);
        }
    }

    private void Load()
    {
        if (!ReferenceEquals(loaded, log.Current))
        {
            memory.Load(log.Current.Bytes);
        }
    }

    /// <summary>The first call of a tick whose acts have no effect any more tells so.</summary>
    private void TellIfEnded(RuleCall call)
    {
        if (world.Deeds.Dropped > 0 && !call.Before.HasEnded)
        {
            world.Notices.Add(RuleNotice.OfEndedChain(
                world.Deeds.Dropped, $"{RuleCallText.Of(world.Scene, RuleCallText.Method(call.Key.Kind), call.Key, call.Trigger)} wanted to do more, but in one"
                    + $" tick rules may cause {RuleTally.MaxRounds} rounds of events, do {RuleTally.MaxActs} things to bodies and hear contacts and crossings"
                    + $" among {RuleTally.MaxCalls} calls; the rest had no effect."));
        }
    }

    /// <summary>Whether a failed call counts as none: a command, if the rules say so, and if what failed are they and not the machine or a
    /// call that was given up. Nothing else that a call asks of the world ends the world by itself, so any other exception is the rules'
    /// own.</summary>
    private bool MaySkip(RuleCall call, Exception failure) =>
        call.Key.Kind == EventKind.Command && rules.SkipsFailedCommands && running?.IsGivenUp != true
        && failure is not (OutOfMemoryException or InsufficientExecutionStackException);

    /// <summary>What a call did is forgotten but for what it read, since that may change and with it whether it fails.</summary>
    private protected virtual void Skip(RuleCall call, Exception failure)
    {
        memory.Load(log.Current.Bytes);
        world.Forget();
        string why = $"{Sentence(call, failure.Message)} The command counts as none.";
        world.Notices.Add(RuleNotice.OfFailedCommand(call.Key.Peer, call.Trigger.Command!.Number, why));
        if (!hasTraced)
        {
            hasTraced = true;
            Trace.TraceWarning(why);
        }
    }

    private InstantException Failed(RuleCall call, string why, Exception? cause) =>
        new(Sentence(call, why), call.Key.Time, cause);

    private string Sentence(RuleCall call, string why) =>
        RuleCallText.Failed(world.Scene, RuleCallText.Method(call.Key.Kind), call.Key, call.Trigger, why);
}
