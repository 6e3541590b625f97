using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The calls of rules inside the window, in canonical order, and the state after each: the timeline of a game's own state.</summary>
/// <remarks>
/// <para>Calls up to <see cref="Position"/> stand. Those from there on are still to be made, or to be looked at again because the world was
/// rewound: a call that would be made with the same state, and would read the same, stands without being made again.</para>
/// <para>A call whose event was cut off stays as gone until the world comes there. Most events that a heal cuts happen again.</para>
/// </remarks>
internal class RuleLog : IRuleTriggers
{
    private readonly RuleHearing hearing;
    private readonly SimTime start;
    private readonly List<RuleCall> calls = new();
    private readonly Stack<RuleCall> free = new();
    private readonly StateVersions versions = new();
    private StateVersion? first; // the state before the calls that are kept
    private StateVersion? current; // the state at the position
    private StateVersion? beforeRollback; // the newest state when the rollback began
    private int unheard; // of those that stand, how many rules were not called for
    private ulong forgotten; // hashes of calls that are no longer kept
    private EventKey? changed; // from where on what rules tell may have changed, since the listener last asked
    private bool isListenedTo;

    /// <summary>Of a world that continues from an encoded state.</summary>
    internal RuleLog(Scene scene, SimTime start, ReadOnlySpan<byte> state)
    {
        hearing = new RuleHearing(scene);
        this.start = start;
        first = versions.Add(state, null);
        versions.Replace(ref current, first);
        versions.Replace(ref beforeRollback, first);
    }

    /// <summary>Knows which method of the rules is called; null if nobody looks.</summary>
    internal RunningRuleCall? Running
    {
        get => hearing.Running;
        set => hearing.Running = value;
    }

    /// <summary>How many calls stand; the call at this place is the next.</summary>
    internal int Position { get; private set; }

    /// <summary>How many of those that stand rules were called for.</summary>
    internal int Heard => Position - unheard;

    /// <summary>How many calls are kept, those that do not stand included.</summary>
    internal int Count => calls.Count;

    /// <summary>How many bytes the states take that are kept.</summary>
    internal long StateBytes => versions.Bytes;

    /// <summary>The state at the position, encoded.</summary>
    internal StateVersion Current => current!;

    /// <summary>A call that is kept.</summary>
    internal RuleCall this[int n] => calls[n];

    void IRuleTriggers.OnContact(in EventKey impact, in ImpactContact contact)
    {
        if (hearing.Hears(impact, contact))
        {
            Add(impact, new RuleTrigger(contact));
        }
    }

    void IRuleTriggers.OnCrossing(in Crossing crossing)
    {
        if (hearing.Hears(crossing))
        {
            Add(crossing.Key, new RuleTrigger(crossing.Entered));
        }
    }

    void IRuleTriggers.OnOpened(BodyId body, in EventKey key)
    {
        if (hearing.Hears(body, key))
        {
            Add(key, default);
        }
    }

    void IRuleTriggers.OnCut(BodyId body, in EventKey key)
    {
        if (key.Kind is not (EventKind.Impact or EventKind.Crossing) && !hearing.Hears(body, key))
        {
            return;
        }

        for (int n = FirstFrom(key); n < calls.Count && calls[n].Key == key; n++)
        {
            calls[n].IsGone = true;
            ReturnTo(n);
        }
    }

    /// <summary>When the next call is due: one that is kept, or of a timer.</summary>
    internal bool TryGetNext(out EventKey key)
    {
        bool isKept = Position < calls.Count;
        key = isKept ? calls[Position].Key : default;
        if (StateLayout.Timers(current!.Head) == 0)
        {
            return isKept;
        }

        EventKey timer = KeyOf(StateLayout.Timer(current.Head, 0));
        if (!isKept || EventKey.Compare(timer, key) < 0)
        {
            key = timer;
        }

        return true;
    }

    /// <summary>The call that is next, at the position: made for a timer that is due, if it is not kept already.</summary>
    internal RuleCall Next()
    {
        EventKey timer = StateLayout.Timers(current!.Head) > 0 ? KeyOf(StateLayout.Timer(current.Head, 0)) : default;
        bool isDue = timer.Kind == EventKind.Timer;
        if (isDue && (Position == calls.Count || EventKey.Compare(timer, calls[Position].Key) < 0))
        {
            Insert(Position, timer, default);
        }

        RuleCall next = calls[Position];
        next.IsGone |= next.Key.Kind == EventKind.Timer && !(isDue && next.Key == timer);
        return next;
    }

    /// <summary>Adds what rules are to be called for, or finds the call that is kept for it.</summary>
    internal virtual void Add(in EventKey key, in RuleTrigger trigger)
    {
        int at = FirstFrom(key);
        for (int end = FirstFrom(key.JustAfter); at < end;) // of the contacts of one impact
        {
            int middle = (at + end) / 2;
            (at, end) = RuleTrigger.Compare(trigger, calls[middle].Trigger) > 0 ? (middle + 1, end) : (at, middle);
        }

        if (at == calls.Count || calls[at].Key != key || RuleTrigger.Compare(trigger, calls[at].Trigger) != 0)
        {
            Insert(at, key, trigger);
        }
        else
        {
            calls[at].IsMade &= calls[at].Trigger.IsSameAs(trigger);
            calls[at].Trigger = trigger;
            calls[at].IsGone = false;
        }

        ReturnTo(at);
    }

    /// <summary>Whether a call for an event of no body, such as a command, is kept.</summary>
    internal bool Has(in EventKey key)
    {
        int at = FirstFrom(key);
        return at < calls.Count && calls[at].Key == key && !calls[at].IsGone;
    }

    /// <summary>Finds what a peer told rules as its event of a sequence, wherever it takes effect.</summary>
    internal bool TryFindTold(ulong origin, out EventKey key)
    {
        int n = calls.Count - 1;
        while (n >= 0 && (!EventKinds.IsForRules(calls[n].Key.Kind) || calls[n].Key.Origin != origin || calls[n].IsGone))
        {
            n--;
        }

        key = n < 0 ? default : calls[n].Key;
        return n >= 0;
    }

    /// <summary>What a call was for, something that rules were told, never was.</summary>
    internal void Retract(in EventKey key)
    {
        int at = FirstFrom(key);
        calls[at].IsGone = true;
        ReturnTo(at);
    }

    /// <summary>Calls from a key on are to be looked at again.</summary>
    internal void RewindTo(in EventKey key) => ReturnTo(FirstFrom(key));

    /// <summary>The call at the position stands, with the state after it.</summary>
    internal void Stand()
    {
        versions.Replace(ref current, calls[Position].StateAfter);
        unheard += calls[Position].IsUnheard ? 1 : 0;
        Position++;
    }

    /// <summary>The call at the position was made, and stands, with this state after it.</summary>
    internal void Stand(ReadOnlySpan<byte> state)
    {
        RuleCall call = calls[Position];
        call.IsMade = true;
        versions.Replace(ref call.StateBefore, current);
        if (current!.IsSameAs(state))
        {
            versions.Replace(ref call.StateAfter, current);
        }
        else if (call.StateAfter is not null && call.StateAfter.IsSameAs(state))
        {
            // as the last time that it was made
        }
        else
        {
            versions.Replace(ref call.StateAfter, null);
            call.StateAfter = versions.Add(state, current);
        }

        Stand();
    }

    /// <summary>Drops the call at the position, of which nothing is left.</summary>
    internal void Drop()
    {
        if (calls[Position].Notices.Count > 0)
        {
            NoteNotices(calls[Position].Key);
        }

        Release(calls[Position]);
        calls.RemoveAt(Position);
    }

    /// <summary>What rules tell at a key has changed.</summary>
    internal void NoteNotices(in EventKey key)
    {
        if (isListenedTo && (changed is not EventKey known || EventKey.Compare(key, known) < 0))
        {
            changed = key;
        }
    }

    /// <summary>From now on calls are kept until a listener has asked for what has changed.</summary>
    internal void Listen()
    {
        isListenedTo = true;
        changed = EventKey.Before(start);
    }

    /// <summary>From where on what rules tell may have changed since this was last asked; false if nothing has.</summary>
    internal bool TryTakeChanged(out EventKey from)
    {
        bool hasChanged = changed is not null;
        from = changed ?? default;
        changed = null;
        return hasChanged;
    }

    /// <summary>A rollback begins.</summary>
    internal void BeginRollback() => versions.Replace(ref beforeRollback, current);

    /// <summary>
    /// Whether the calls that are left, made before the rollback, would all stand if nothing else changed: the state is the one that the
    /// first of them was made with.
    /// </summary>
    internal virtual bool HaveReconverged() =>
        (Position < calls.Count && calls[Position].IsMade ? calls[Position].StateBefore : beforeRollback)!.IsSameAs(current!);

    /// <summary>All that is left happens as before the rollback, up to a time: the calls stand.</summary>
    internal void PutBack(SimTime to)
    {
        while (Position < calls.Count && calls[Position].IsMade && calls[Position].Key.Time <= to)
        {
            calls[Position].IsGone = false;
            Stand();
        }
    }

    /// <summary>Forgets calls before a time, which can no longer change, once they are an eighth of all: the rest has to be
    /// moved.</summary>
    internal void DropBefore(SimTime edge)
    {
        if (Position > 0 && calls[Position / 8].Key.Time < edge)
        {
            DropAllBefore(edge);
        }
    }

    /// <summary>Forgets all calls before a time, however few.</summary>
    internal void DropAllBefore(SimTime edge)
    {
        int count = 0;
        while (count < Position && calls[count].Key.Time < edge && !(changed is EventKey from && EventKey.Compare(calls[count].Key, from) >= 0))
        {
            forgotten += HashOf(calls[count]);
            versions.Replace(ref first, calls[count].StateAfter);
            unheard -= calls[count].IsUnheard ? 1 : 0;
            Release(calls[count]);
            count++;
        }

        calls.RemoveRange(0, count);
        Position -= count;
    }

    /// <summary>The place of the first call that stands after a time; <see cref="Position"/> if none does.</summary>
    internal int FirstAfter(SimTime time) =>
        time == SimTime.MaxValue ? Position : Math.Min(Position, FirstFrom(EventKey.Before(time + SimDuration.OneTick)));

    /// <summary>The state after everything up to and including a time.</summary>
    internal StateVersion StateAt(SimTime time) => FirstAfter(time) is int n && n > 0 ? calls[n - 1].StateAfter! : first!;

    /// <summary>The sum of the hashes of all calls up to and including a time, with the state after each.</summary>
    internal ulong EventHash(SimTime time)
    {
        ulong sum = forgotten;
        for (int n = 0; n < Position && calls[n].Key.Time <= time; n++)
        {
            sum += HashOf(calls[n]);
        }

        return sum;
    }

    /// <summary>The first call keyed at or after a key, or their number.</summary>
    internal int FirstFrom(in EventKey key)
    {
        int low = 0;
        int high = calls.Count;
        int middle = Math.Max(0, high - 1); // the newest first, since most look for what happened last
        while (low < high)
        {
            (low, high) = EventKey.Compare(calls[middle].Key, key) >= 0 ? (low, middle) : (middle + 1, high);
            middle = (low + high) / 2;
        }

        return low;
    }

    private static EventKey KeyFor(SimTime time, uint round, int number) =>
        new(time, round, EventKind.Timer, default, default, 0, unchecked((uint)number));

    private EventKey KeyOf(in RuleTimer timer) => KeyFor(timer.Time(start), timer.Round, timer.Number);

    private ulong HashOf(RuleCall call)
    {
        StableHash hash = default;
        hash.Add(0x5C5E7A7EUL);
        hash.Add(call.Key.Time - start);
        hash.Add(((ulong)call.Key.Round << 8) | (byte)call.Key.Kind);
        hash.Add(call.Key.Body.Packed);
        hash.Add(call.Key.Origin);
        StateLayout.AddTo(ref hash, call.StateAfter!.Bytes);
        return hash.Value;
    }

    private void Insert(int at, in EventKey key, in RuleTrigger trigger)
    {
        RuleCall call = free.Count > 0 ? free.Pop() : new RuleCall();
        call.Key = key;
        call.Trigger = trigger;
        calls.Insert(at, call);
    }

    /// <summary>The calls from a place on do not stand any more, if they did.</summary>
    private void ReturnTo(int place)
    {
        if (place < Position)
        {
            for (; Position > place; Position--)
            {
                unheard -= calls[Position - 1].IsUnheard ? 1 : 0;
            }

            versions.Replace(ref current, place == 0 ? first : calls[place - 1].StateAfter);
        }
    }

    private void Release(RuleCall call)
    {
        versions.Replace(ref call.StateBefore, null);
        versions.Replace(ref call.StateAfter, null);
        call.Reads.Clear();
        call.Acts.Clear();
        call.Notices.Clear();
        call.Trigger = default;
        call.IsMade = false;
        call.IsGone = false;
        call.IsTakenBack = false;
        call.Chains = false;
        call.Before = default;
        call.MadeAfter = default;
        call.Dropped = 0;
        call.IsUnheard = false;
        free.Push(call);
    }
}
