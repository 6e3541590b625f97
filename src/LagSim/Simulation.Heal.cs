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
    /// <summary>Bodies that the impact at hand reaches, though their paths are known beyond it.</summary>
    private readonly List<int> ahead = new();

    /// <summary>What is still to be cut: a body, and the key from which on.</summary>
    private readonly Stack<(int Slot, EventKey Key)> cuts = new();

    /// <summary>Of the heal at hand what it began with, and how many bodies it has predicted anew.</summary>
    private HealReport healed;

    /// <summary>The number of the heal at hand, from one.</summary>
    private uint healNumber;

    private int healedBodies;
    private uint[] healedIn = Array.Empty<uint>(); // by slot: the number of the last heal that predicted the body anew

    /// <summary>Who was cut since anything was predicted anew.</summary>
    private readonly List<int> taken = new();

    /// <summary>
    /// How far the world was simulated before the heal at hand, and so how far the paths of bodies that nothing late has touched are known. The least time
    /// there is where nothing is being healed. A heal may be finished in several advances.
    /// </summary>
    private SimTime front = SimTime.MinValue;

    /// <summary>The event at hand, or the key to which was taken back.</summary>
    private EventKey clock;

    /// <summary>Of the heal at hand: segments up to this one were there before.</summary>
    private long oldSerial;

    /// <summary>What is done wrongly on purpose: only a test's negative control sets it.</summary>
    internal HealingFault Fault { get; set; }

    /// <summary>
    /// The cones of so many news at a time, each in a place of its own, may take up an eighth of all bodies each; more share that half, where a cone is about
    /// as dear as a full rollback.
    /// </summary>
    private const int MostNewsApart = 4;

    /// <summary>
    /// With so few bodies or less a heal never takes all back that it has not touched; an eighth of all for each of the news is the limit with more.
    /// </summary>
    internal int FewHealed { get; set; } = 32;

    private bool Has(HealingFault wrong) => (Fault & wrong) != 0;

    /// <summary>Whether bodies' paths may be known beyond this key: a heal is under way.</summary>
    private bool MayBeAhead(in EventKey key) => key.Time <= front;

    /// <summary>The heal at hand, for the index, if anybody may be ahead of the event at hand; else 0.</summary>
    private long HealAtHand => MayBeAhead(clock) && oldSerial >= 0 ? Rollbacks : 0;

    /// <summary>
    /// Raised on the thread that advances, once per heal, when the world is again where it was. Handlers must not throw, and not change the world.
    /// </summary>
    public event Action<HealReport>? Healed;

    /// <summary>Up to when what bodies do is known of some, and so would have to be rewritten.</summary>
    private SimTime KnownTo => healing == HealingMode.FullRollback ? SimulatedTo : SimTime.Max(SimulatedTo, front);

    void IOpeningObserver.OnOpened(int slot, in EventKey key)
    {
        if (key.Time <= front && key.Kind != EventKind.None) // not of whom nobody has heard yet
        {
            CountHealed(slot); // also who had nothing to be cut, because what struck him now comes after all he did
        }
    }

    private void BeginHeal(SimTime time)
    {
        Rollbacks++;
        if (front == SimTime.MinValue)
        {
            front = SimulatedTo;
            timelines.Openings = this;
            healNumber++;
            healedBodies = 0;
            healed = new HealReport(time, front, 1, 0, SegmentsCut, EventsProcessed);
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
        front = SimTime.MinValue;
        timelines.Openings = null;
        Healed?.Invoke(new HealReport(
            healed.From, healed.To, healed.News, healedBodies, SegmentsCut - healed.SegmentsCut, EventsProcessed - healed.Events, met));
    }

    private void CountHealed(int slot)
    {
        if (slot >= healedIn.Length)
        {
            Array.Resize(ref healedIn, bodies.Room);
        }

        if (healedIn[slot] != healNumber)
        {
            healedIn[slot] = healNumber;
            healedBodies++;
            cutPaths.Touch(slot);
        }
    }

    /// <summary>Takes the body back to the key, and with it what the news can have touched, as it comes to light; and simulates that again.</summary>
    private void Heal(int slot, in EventKey key)
    {
        SimTime to = SimulatedTo;
        clock = EventKey.Before(to + SimDuration.OneTick);
        if (key.Time <= to)
        {
            clock = key;
            oldSerial = timelines.LastSerial; // what an unfinished heal has made anew may be ahead of this one
            SimulatedTo = key.Time - SimDuration.OneTick;
        }

        TakeBack(slot, key);
        AdvanceAsFarAs(DefersAgain ? SimTime.Min(key.Time, to) : to); // put off, it is simulated again once for all that comes at a time
    }

    private void Rewrite(int slot, in EventKey key)
    {
        if (Has(HealingFault.LeavesWhoRests) && timelines.Segment(timelines.Last(slot)).Law == MotionLaw.Resting)
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

    /// <summary>
    /// The piece of its path on which a body meets an impact of this tick and round: its newest, unless it is ahead, with what it did before the heal
    /// from there on still standing.
    /// </summary>
    private int PieceAt(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        if (!MayBeAhead(key) || timelines.Serial(last) > oldSerial || IsOverlooked(slot))
        {
            return last;
        }

        return timelines.Before(slot, RoundOfImpacts(key.Time, key.Round));
    }

    private bool IsOverlooked(int slot) => Has(HealingFault.OverlooksWhoIsAhead) && slot < healedIn.Length && healedIn[slot] == healNumber;

    /// <summary>Cuts a body at the key; whoever shared an impact that is gone is cut there too. All of them are predicted anew.</summary>
    private void TakeBack(int slot, in EventKey key)
    {
        taken.Clear();
        bool cutsByTime = Has(HealingFault.CutsByTime) && key == clock && key.Time > HistoryEdge;
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
                if (!Has(HealingFault.DropsEvents) && !cutsByTime)
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
        if (oldSerial < 0 || healedBodies <= Math.Max(FewHealed, bodies.Count / 8 * Math.Min(healed.News, MostNewsApart)))
        {
            return false;
        }

        GoOnToTheEnd();
        TakeBackAll(clock.Kind == EventKind.Impact ? RoundOfImpacts(clock.Time, clock.Round) : clock);
        return true;
    }

    /// <summary>Takes back, to the round at hand, whom <see cref="Gather"/> found ahead of it; false if nobody was.</summary>
    private bool TryTakeBack(in EventKey key)
    {
        if (ahead.Count == 0)
        {
            return false;
        }

        EventKey round = RoundOfImpacts(key.Time, key.Round);
        while (ahead.Count > 0)
        {
            int slot = ahead[ahead.Count - 1];
            ahead.RemoveAt(ahead.Count - 1);
            TakeBack(slot, round);
        }

        return true;
    }
}
