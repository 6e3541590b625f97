using System;
using System.Collections.Generic;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// Cuts the paths that a late event can have touched, as they become known, so that the event loop simulates them again.
/// </summary>
/// <remarks>
/// It simulates nothing itself: it cuts, has the cut bodies predicted again, and moves back how far the world is simulated.
/// </remarks>
internal class Rewinder : ISegmentOpenedObserver
{
    /// <summary>
    /// The causal cones of so many late events, each in a place of its own, may take up an eighth of all bodies each; more share that half,
    /// where a cone is about as dear as a full rollback.
    /// </summary>
    private const int MaxSeparateCones = 4;

    private readonly BodyTable bodies;
    private readonly TimelineStore timelines;
    private readonly EventLog log;
    private readonly EventScheduler scheduler;
    private readonly Progress progress;
    private readonly RollbackState rollback;
    private readonly Reconvergence reconvergence;
    private readonly EventPredictor predictor;
    private readonly HealingMode mode;
    private readonly PendingCuts cuts;
    private readonly List<int> cut = new(); // the bodies cut since the last prediction
    private HealReport report; // what the current rollback began with

    internal Rewinder(
        BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, Progress progress, RollbackState rollback,
        Reconvergence reconvergence, EventPredictor predictor, HealingMode mode)
    {
        this.bodies = bodies;
        this.timelines = timelines;
        cuts = new PendingCuts(bodies, timelines);
        this.log = log;
        this.scheduler = scheduler;
        this.progress = progress;
        this.rollback = rollback;
        this.reconvergence = reconvergence;
        this.predictor = predictor;
        this.mode = mode;
    }

    /// <summary>The calls of rules, which are looked at again from where bodies are rewound; null, the default, where there are
    /// none.</summary>
    internal RuleLog? Rules { get; set; }

    /// <summary>Raised once per rollback, when the world is again where it was.</summary>
    internal event Action<HealReport>? Healed;

    /// <summary>The crossings of sensors, which are cut with the paths; null in a scene without.</summary>
    internal SensorDependencies? Sensors { get; set; }

    /// <summary>
    /// With so few bodies or less a rollback never rewinds all that it has not touched; an eighth of all for each late event is the limit
    /// with more.
    /// </summary>
    internal int FewHealed { get; set; } = 32;

    /// <summary>Up to when what bodies do is known of some, and so would have to be rewound.</summary>
    internal SimTime KnownTo => mode == HealingMode.FullRollback || !rollback.IsActive
        ? progress.SimulatedTo
        : SimTime.Max(progress.SimulatedTo, rollback.Horizon);

    /// <summary>
    /// Whether the events at a key are known for some bodies. Of the instant that a full rollback has rewound to, events before the key of
    /// the late event stay valid.
    /// </summary>
    internal bool IsKnown(in EventKey key) =>
        key.Time <= KnownTo || (mode == HealingMode.FullRollback && EventKey.Compare(key, rollback.Cursor) < 0);

    void ISegmentOpenedObserver.OnOpened(int slot, in EventKey key)
    {
        if (key.Time <= rollback.Horizon && key.Kind != EventKind.None) // not a body that is not known yet
        {
            Touch(slot); // also a body with nothing to cut, because what strikes it now comes after all its segments
            if (Sensors is not null)
            {
                CutCrossings(Sensors.Log, slot, key); // what it crossed later on the segment that ends here
                NoteDependents(Sensors, slot, key);
            }
        }
    }

    /// <summary>An event is done: bodies that crossed later what is carried on paths that have ended with it are rewound.</summary>
    internal void RewindCarried()
    {
        while (Sensors is not null && Sensors.TryTakeDependent(out int slot, out EventKey key))
        {
            Rewind(slot, key);
        }
    }

    /// <summary>
    /// A body's path is known beyond a key at which something has changed: it is cut there, and the world is simulated no further than to
    /// before the key.
    /// </summary>
    internal virtual void Mark(int slot, in EventKey key)
    {
        SimTime last = LastPlacingTime();
        if (!IsBegunAt(key))
        {
            Rewind(slot, key);
            RewindPlacings(key, last);
        }
    }

    /// <summary>At a key a command has come or gone: the calls of rules are looked at again from there on, and the world is simulated no
    /// further than to before it.</summary>
    internal virtual void MarkRules(in EventKey key)
    {
        SimTime last = LastPlacingTime();
        if (!IsBegunAt(key))
        {
            RewindPlacings(key, last);
        }
    }

    /// <summary>Begins a rollback to a key, or has the one that is under way include it; true if that has rewound all bodies.</summary>
    private bool IsBegunAt(in EventKey key)
    {
        Begin(key.Time);
        if (mode == HealingMode.FullRollback)
        {
            progress.SimulatedTo = key.Time - SimDuration.OneTick;
            RewindAll(key);
            return true;
        }

        Rules?.RewindTo(key);
        if (key.Time <= progress.SimulatedTo)
        {
            rollback.Cursor = key;
            rollback.BecomeCausalCone(timelines.LastSerial);
            progress.SimulatedTo = key.Time - SimDuration.OneTick;
        }
        else
        {
            rollback.Cursor = EventKey.Before(progress.SimulatedTo + SimDuration.OneTick);
        }

        return false;
    }

    /// <summary>
    /// Up to when events that put a body where another may be have to be rewound: as far as the world is known, unless a rollback is under way,
    /// which has rewound those that come after what it has done. So many late events do not rewind all of them each.
    /// </summary>
    private SimTime LastPlacingTime() => rollback.Kind == RollbackKind.CausalCone ? progress.SimulatedTo + SimDuration.OneTick : KnownTo;

    /// <summary>
    /// Events that put a body where another may be are decided again: what a heal does before them may change who is there, also a body that
    /// was not there.
    /// </summary>
    /// <param name="after">From which key on.</param>
    /// <param name="last">Up to when.</param>
    private protected virtual void RewindPlacings(in EventKey after, SimTime last)
    {
        EventKey key = after;
        int at = log.PlacingAfter(key, out int slot);
        while (at != EventLog.None && log.Key(at).Time <= last && rollback.Kind == RollbackKind.CausalCone)
        {
            key = log.Key(at);
            Rewind(slot, key);
            at = log.PlacingAfter(key, out slot);
        }
    }

    /// <summary>
    /// Cuts a body at the key; all bodies that shared a removed event are cut there too. All of them are predicted again. If the rollback
    /// has grown to so many bodies that it will grow to nearly all, all are rewound to the current event.
    /// </summary>
    internal void Rewind(int slot, in EventKey key)
    {
        Cut(slot, key);
        if (IsNearlyFull())
        {
            reconvergence.GiveUp();
            RewindAll(rollback.Cursor.Kind == EventKind.Impact ? EventKey.BeforeImpacts(rollback.Cursor.Time, rollback.Cursor.Round) : rollback.Cursor);
            return;
        }

        foreach (int body in cut)
        {
            predictor.Predict(body);
        }
    }

    /// <summary>Cuts all that has happened in an instant, for good.</summary>
    internal virtual void RewindInstant(SimTime instant)
    {
        reconvergence.GiveUp();
        RewindAll(instant > progress.Start ? EventKey.Before(instant) : AfterStart());
    }

    /// <summary>At an instant, of which all is done, the rollback ends if the paths have reconverged; false if not.</summary>
    /// <param name="at">The instant.</param>
    /// <param name="until">How far the world is to be advanced.</param>
    internal bool TryReconverge(SimTime at, SimTime until)
    {
        if (!reconvergence.IsReached(at, until))
        {
            return false;
        }

        SimTime reconvergedAt = rollback.Cursor.Time;
        reconvergence.PutBack(at);
        End(reconvergedAt);
        return true;
    }

    /// <summary>Ends the rollback if the world is simulated as far as before it.</summary>
    internal void EndIfDone()
    {
        if (rollback.IsActive && progress.SimulatedTo >= rollback.Horizon)
        {
            End(null);
        }
    }

    /// <summary>The first instant is rewound to after the start of the scene's bodies and of its rules, which nothing comes before.</summary>
    private EventKey AfterStart()
    {
        BodyId last = BodyId.FromPacked(ulong.MaxValue);
        return new EventKey(progress.Start, 0, EventKind.Start, last, last, 0, 0).JustAfter;
    }

    private void Begin(SimTime time)
    {
        rollback.CountLate();
        if (!rollback.IsActive)
        {
            rollback.Begin(mode == HealingMode.FullRollback ? RollbackKind.Full : RollbackKind.CausalCone, progress.SimulatedTo);
            timelines.Openings = this;
            Rules?.BeginRollback();
            report = new HealReport(time, rollback.Horizon, 1, 0, rollback.SegmentsCut, progress.EventsProcessed);
            if (mode != HealingMode.FullRollback)
            {
                reconvergence.Begin();
            }
        }
        else
        {
            reconvergence.GiveUp(); // earlier segments can no longer be distinguished from those that the rollback has made
            report = new HealReport(SimTime.Min(report.From, time), report.To, report.LateEvents + 1, 0, report.SegmentsCut, report.Events);
        }
    }

    private void End(SimTime? reconvergedAt)
    {
        reconvergence.GiveUp();
        rollback.End();
        timelines.Openings = null;
        Healed?.Invoke(new HealReport(
            report.From, report.To, report.LateEvents, rollback.BodyCount, rollback.SegmentsCut - report.SegmentsCut,
            progress.EventsProcessed - report.Events, reconvergedAt));
    }

    private void Touch(int slot)
    {
        if (rollback.Touch(slot))
        {
            reconvergence.Touch(slot);
        }
    }

    private void Cut(int slot, in EventKey key)
    {
        cut.Clear();
        cuts.Begin(slot, CutsFrom(key));
        log.AddDueFrom(slot, key);
        cut.Add(slot);
        Touch(slot);
        while (cuts.TryPop(out int body, out EventKey from))
        {
            bool any = false;
            for (int at = timelines.Last(body); at != TimelineStore.None && EventKey.Compare(timelines.Key(at), from) >= 0; at = timelines.Last(body))
            {
                for (int other = timelines.Together(at); other != at; other = timelines.Together(other))
                {
                    cuts.Push(timelines.Owner(other), timelines.Key(other));
                }

                Touch(body);
                reconvergence.Keep(body, at);
                timelines.CutLast(body, bodies.Id(body));
                rollback.SegmentsCut++;
                any = true;
            }

            CutStruckWith(body, from);
            if (Sensors is not null)
            {
                if (body != slot && Sensors.HasFrom(body, from))
                {
                    Touch(body);
                    any = true; // it crosses what the other carries
                }

                CutCrossings(Sensors.Log, body, from);
                NoteDependents(Sensors, body, from);
                while (Sensors.TryTakeDependent(out int dependent, out EventKey crossing))
                {
                    cuts.Push(dependent, crossing);
                }
            }

            if (any)
            {
                CutWhatWakes(body, from);
                Redo(body, from);
                if (body != slot)
                {
                    cut.Add(body);
                }
            }
        }
    }

    /// <summary>
    /// Cuts those that a body was struck with earlier in the instant of a key, and that were struck again in it after the key: whether that
    /// is a collapse depends on who still touches them.
    /// </summary>
    private protected virtual void CutStruckWith(int body, in EventKey from) => cuts.PushStruckWith(body, from);

    /// <summary>Cuts those that a body lies on which is left asleep, from what is done to them next: that wakes it.</summary>
    private protected virtual void CutWhatWakes(int body, in EventKey from) => cuts.PushWhatWakes(body, from);

    /// <summary>Notes the bodies that from a key on cross what a body carries.</summary>
    private protected virtual void NoteDependents(SensorDependencies sensors, int slot, in EventKey from) =>
        sensors.NoteDependents(slot, from);

    /// <summary>From which key on a body is cut that is rewound to a key: from that very key.</summary>
    private protected virtual EventKey CutsFrom(in EventKey key) => key;

    /// <summary>From which key on every body is cut in a full rollback to a key: from that very key, not from its time.</summary>
    private protected virtual EventKey CutsAllFrom(in EventKey key) => key;

    /// <summary>Cuts a body's crossings of sensors from a key on: what it crosses from there on has to be found again.</summary>
    private protected virtual void CutCrossings(CrossingLog crossings, int slot, in EventKey from)
    {
        reconvergence.KeepCrossings(slot, from);
        crossings.CutFrom(slot, from);
    }

    /// <summary>Has the external events of a body that was cut applied again.</summary>
    private protected virtual void Redo(int slot, in EventKey from) => log.AddDueFrom(slot, from);

    /// <summary>
    /// Whether simulating all bodies again costs less than finding out at every step which bodies are ahead, and what they did there.
    /// </summary>
    private bool IsNearlyFull() =>
        rollback.Kind == RollbackKind.CausalCone
        && rollback.BodyCount > Math.Max(FewHealed, bodies.Count / 8 * Math.Min(report.LateEvents, MaxSeparateCones));

    /// <summary>Cuts every timeline at the key and has all bodies predicted again.</summary>
    private void RewindAll(in EventKey key)
    {
        rollback.Cursor = key;
        rollback.BecomeFull();
        Rules?.RewindTo(key);
        EventKey from = CutsAllFrom(key);
        for (int slot = 0; slot < bodies.SlotCount; slot++)
        {
            rollback.SegmentsCut += timelines.CutFrom(slot, bodies.Id(slot), from);
            if (Sensors is not null)
            {
                CutCrossings(Sensors.Log, slot, from);
            }

            log.SetDueFrom(slot, key);
            scheduler.Remove(slot);
        }

        for (int slot = 0; slot < bodies.SlotCount; slot++)
        {
            Touch(slot);
            predictor.Predict(slot);
        }
    }
}
