using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Healing: late news rewrites only what it can have touched.</content>
public sealed partial class Simulation
{
    /// <summary>What is still to be cut: a body, and the key from which on.</summary>
    private readonly Stack<(int Slot, EventKey Key)> cuts = new();

    /// <summary>Of the heal at hand what it began with, and how many bodies it has predicted anew.</summary>
    private HealReport healed;

    /// <summary>Who was cut since anything was predicted anew.</summary>
    private readonly List<int> taken = new();

    /// <summary>What is done wrongly on purpose: only a test's negative control sets it.</summary>
    internal HealingFault Fault
    {
        get => faults.Healing;
        set => faults.Healing = value;
    }

    /// <summary>
    /// The cones of so many news at a time, each in a place of its own, may take up an eighth of all bodies each; more share that half, where a cone is about
    /// as dear as a full rollback.
    /// </summary>
    private const int MostNewsApart = 4;

    /// <summary>
    /// With so few bodies or less a heal never takes all back that it has not touched; an eighth of all for each of the news is the limit with more.
    /// </summary>
    internal int FewHealed { get; set; } = 32;

    /// <summary>The heal at hand, for the index, if anybody may be ahead of the event at hand; else 0.</summary>
    private long HealAtHand => rollback.MayBeKnownBeyond(rollback.Cursor) && rollback.LastOld >= 0 ? Rollbacks : 0;

    /// <summary>
    /// Raised on the thread that advances, once per heal, when the world is again where it was. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<HealReport>? Healed;

    /// <summary>Up to when what bodies do is known of some, and so would have to be rewritten.</summary>
    private SimTime KnownTo => healing == HealingMode.FullRollback ? SimulatedTo : SimTime.Max(SimulatedTo, rollback.Horizon);

    void IOpeningObserver.OnOpened(int slot, in EventKey key)
    {
        if (key.Time <= rollback.Horizon && key.Kind != EventKind.None) // not of whom nobody has heard yet
        {
            CountHealed(slot); // also who had nothing to be cut, because what struck him now comes after all he did
        }
    }

    private void BeginHeal(SimTime time)
    {
        Rollbacks++;
        if (!rollback.IsActive)
        {
            rollback.Begin(SimulatedTo);
            timelines.Openings = this;
            healed = new HealReport(time, rollback.Horizon, 1, 0, SegmentsCut, EventsProcessed);
            if (healing != HealingMode.FullRollback)
            {
                cutPaths.Begin(timelines.LastSerial);
                heldBack.Hold();
            }
        }
        else
        {
            GoOnToTheEnd(); // what stood before is no longer to be told from what the heal has made
            healed = new HealReport(SimTime.Min(healed.From, time), healed.To, healed.News + 1, 0, healed.SegmentsCut, healed.Events);
        }
    }

    private void EndHeal(SimTime? met = null)
    {
        GoOnToTheEnd();
        isTwinDue = true;
        rollback.Horizon = SimTime.MinValue;
        timelines.Openings = null;
        Healed?.Invoke(new HealReport(
            healed.From, healed.To, healed.News, rollback.BodyCount, SegmentsCut - healed.SegmentsCut, EventsProcessed - healed.Events, met));
    }

    private void CountHealed(int slot)
    {
        if (rollback.Touch(slot))
        {
            cutPaths.Touch(slot);
        }
    }

    /// <summary>Takes the body back to the key, and with it what the news can have touched, as it comes to light; and simulates that again.</summary>
    private void Heal(int slot, in EventKey key)
    {
        SimTime to = SimulatedTo;
        rollback.Cursor = EventKey.Before(to + SimDuration.OneTick);
        if (key.Time <= to)
        {
            rollback.Cursor = key;
            rollback.LastOld = timelines.LastSerial; // segments that an unfinished rollback has remade may lie beyond this one
            SimulatedTo = key.Time - SimDuration.OneTick;
        }

        TakeBack(slot, key);
        AdvanceAsFarAs(DefersAgain ? SimTime.Min(key.Time, to) : to); // put off, it is simulated again once for all that comes at a time
    }

    private void Rewrite(int slot, in EventKey key)
    {
        if (faults.Has(HealingFault.LeavesWhoRests) && timelines.Segment(timelines.Last(slot)).Law == MotionLaw.Resting)
        {
            return;
        }

        BeginHeal(key.Time);
        if (healing == HealingMode.FullRollback)
        {
            RollBack(key);
        }
        else
        {
            Heal(slot, key);
        }
    }

    /// <summary>Cuts a body at the key; whoever shared an impact that is gone is cut there too. All of them are predicted anew.</summary>
    private void TakeBack(int slot, in EventKey key)
    {
        taken.Clear();
        bool cutsByTime = faults.Has(HealingFault.CutsByTime) && key == rollback.Cursor && key.Time > HistoryEdge;
        cuts.Push((slot, cutsByTime ? EventKey.Before(key.Time) : key));
        log.AddDueFrom(slot, key);
        taken.Add(slot);
        CountHealed(slot);
        while (cuts.Count > 0)
        {
            (int body, EventKey from) = cuts.Pop();
            bool any = false;
            for (int at = timelines.Last(body); at != TimelineStore.None && EventKey.Compare(timelines.Key(at), from) >= 0; at = timelines.Last(body))
            {
                for (int other = timelines.Together(at); other != at; other = timelines.Together(other))
                {
                    cuts.Push((timelines.Owner(other), timelines.Key(other)));
                }

                CountHealed(body);
                cutPaths.Keep(timelines, body, at);
                timelines.CutLast(body, bodies.Id(body));
                SegmentsCut++;
                any = true;
            }

            if (any)
            {
                if (!faults.Has(HealingFault.DropsEvents) && !cutsByTime)
                {
                    log.AddDueFrom(body, from);
                }

                taken.Add(body);
            }
        }

        if (HasTakenBackAll())
        {
            return;
        }

        foreach (int body in taken)
        {
            Predict(body);
        }
    }

    /// <summary>
    /// A heal whose cone has grown to so many bodies that it will grow to nearly all takes all back to the event at hand: to simulate everybody again costs
    /// less than to ask at every step who is ahead, and what he did there.
    /// </summary>
    private bool HasTakenBackAll()
    {
        if (rollback.LastOld < 0 || rollback.BodyCount <= Math.Max(FewHealed, bodies.Count / 8 * Math.Min(healed.News, MostNewsApart)))
        {
            return false;
        }

        GoOnToTheEnd();
        TakeBackAll(rollback.Cursor.Kind == EventKind.Impact ? EventKey.BeforeImpacts(rollback.Cursor.Time, rollback.Cursor.Round) : rollback.Cursor);
        return true;
    }

    /// <summary>Takes back, to the round at hand, whom <see cref="Gather"/> found ahead of it; false if nobody was.</summary>
    private bool TryTakeBack(in EventKey key)
    {
        if (partners.Ahead.Count == 0)
        {
            return false;
        }

        EventKey round = EventKey.BeforeImpacts(key.Time, key.Round);
        while (partners.Ahead.Count > 0)
        {
            int slot = partners.Ahead[partners.Ahead.Count - 1];
            partners.Ahead.RemoveAt(partners.Ahead.Count - 1);
            TakeBack(slot, round);
        }

        return true;
    }
}
