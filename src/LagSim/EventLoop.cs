using System;
using System.Threading;
using LagSim.BroadPhase;
using LagSim.Events;
using LagSim.Handlers;
using LagSim.Rollback;
using LagSim.Time;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim;

/// <summary>The event loop: takes the least event that is due, or call of rules, has it processed, and moves on how far the world is simulated.</summary>
/// <remarks>
/// An instant happens as a whole, unless an end is asked for. In a session's world an advance may stop within one that takes long, and one
/// in which rules fail blocks the world until an event removes the cause.
/// </remarks>
internal sealed class EventLoop(
    Progress progress, TimelineStore timelines, Agenda agenda, RollbackState rollback, Rewinder rewinder,
    EventDispatcher dispatcher, AdaptiveBroadPhase broadPhase, WorkMeter meter, ForceFailures failures,
    RuleCaller? caller, CancellationToken cancellation)
{
    private Exception? fault;
    private SimTime? partDone; // the instant that has happened only in part

    /// <summary>
    /// Whether an advance may stop within an instant, and whether one in which rules fail blocks the world until an
    /// event comes that lies no later; otherwise an instant happens as a whole, and such a one ends the simulation.
    /// </summary>
    internal bool WaitsForLateEvents { get; set; }

    /// <summary>The instant that blocks the world, and why; null if none does.</summary>
    internal InstantException? Blocked { get; private set; }

    /// <summary>The instant that blocks the world; the latest time there is if none does.</summary>
    internal SimTime BlockedAt => Blocked?.At ?? SimTime.MaxValue;

    /// <summary>Whether a part of an instant has happened, and the rest has not.</summary>
    internal bool IsPartDone => partDone is not null;

    /// <summary>Throws if an exception has ended the simulation.</summary>
    internal void ThrowIfFaulted()
    {
        if (fault is not null)
        {
            throw new InvalidOperationException("The simulation has faulted and cannot go on; see the inner exception.", fault);
        }
    }

    /// <summary>Throws if an end was asked for.</summary>
    internal void ThrowIfCancelled() => cancellation.ThrowIfCancellationRequested();

    /// <summary>
    /// Throws if an instant blocks the world up to a time. The world can continue once an event comes that removes the cause.
    /// </summary>
    internal void ThrowIfBlockedAt(SimTime time)
    {
        if (Blocked is InstantException failed && failed.At <= time)
        {
            throw failed.AsEnd();
        }
    }

    /// <summary>Ends the simulation, which throws from now on.</summary>
    /// <returns>The exception.</returns>
    internal Exception Fail(Exception failure) => fault = failure;

    /// <summary>
    /// Processes events up to and including a time, or as many as <paramref name="events"/> allows; see
    /// <see cref="Simulation.TryAdvanceTo"/>.
    /// </summary>
    /// <exception cref="OperationCanceledException">The token was cancelled; everything before <see cref="Progress.SimulatedTo"/>
    /// stays.</exception>
    internal bool TryAdvanceTo(SimTime time, ref long events)
    {
        SimTime reached = progress.SimulatedTo;
        SimTime until = SimTime.Min(time, BlockedAt - SimDuration.OneTick);
        Stop stop = Stop.None;
        try
        {
            stop = Run(until, time, ref events, ref reached);
        }
        catch (InstantException failed) when (MayWaitBefore(failed.At))
        {
            Blocked = failed;
            RewindInstant(failed.At);
            until = failed.At - SimDuration.OneTick;
        }
        catch (SimulationException failure) when (failure is not TimelinesFullException)
        {
            Fail(failure);
            throw;
        }
        catch (Exception failure)
        {
            throw Fail(Ending(failure, reached));
        }

        progress.SimulatedTo = stop != Stop.None ? reached : until;
        rollback.MoveOn(EventKey.Before(progress.SimulatedTo + SimDuration.OneTick));
        rewinder.EndIfDone();
        ForgetUpTo(progress.SimulatedTo);
        if (stop == Stop.Cancelled)
        {
            throw new OperationCanceledException(cancellation);
        }

        return stop == Stop.None && until == time;
    }

    /// <summary>
    /// An event was added or taken away: it may free a blocked world, and what has happened of a part-done instant is computed again with
    /// it.
    /// </summary>
    internal void Reconsider(SimTime changed)
    {
        if (changed <= BlockedAt)
        {
            Blocked = null;
        }

        if (partDone is SimTime instant && changed <= SimTime.Max(instant, rewinder.KnownTo))
        {
            RewindInstant(instant);
        }
    }

    /// <param name="until">Up to when events happen.</param>
    /// <param name="asked">Up to when was asked for.</param>
    /// <param name="events">How many may happen; what is left.</param>
    /// <param name="reached">The last instant of which all has happened.</param>
    private Stop Run(SimTime until, SimTime asked, ref long events, ref SimTime reached)
    {
        WorkVerdict verdict = WorkVerdict.GoOn;
        while (agenda.TryGetLeast(out int slot, out EventKey least) && least.Time <= until)
        {
            if (least.Time > reached)
            {
                if (least.Time != partDone && rewinder.TryReconverge(least.Time - SimDuration.OneTick, asked))
                {
                    reached = progress.SimulatedTo;
                    continue;
                }

                if (cancellation.IsCancellationRequested || events <= 0)
                {
                    return cancellation.IsCancellationRequested ? Stop.Cancelled : Stop.OutOfEvents;
                }

                reached = least.Time;
                partDone = null;
                ForgetUpTo(reached);
            }
            else if (cancellation.IsCancellationRequested || (verdict == WorkVerdict.StopNow && MayWaitBefore(reached)))
            {
                partDone = reached;
                reached -= SimDuration.OneTick;
                return cancellation.IsCancellationRequested ? Stop.Cancelled : Stop.OutOfEvents;
            }

            events--;
            WorkVerdict said = slot == Agenda.Rules ? CallRules(least) : Happen(slot, least);
            verdict = said > verdict ? said : verdict;
            events = verdict == WorkVerdict.GoOn ? events : Math.Min(events, 0);
        }

        return Stop.None;
    }

    private WorkVerdict Happen(int slot, in EventKey key)
    {
        rollback.Cursor = key;
        if (meter.Observer is null)
        {
            dispatcher.Process(slot, key);
            return WorkVerdict.GoOn;
        }

        meter.Begin();
        dispatcher.Process(slot, key);
        return meter.Tell(slot, key);
    }

    /// <summary>
    /// Rules may hear of an impact by a key that comes before the one by which it was scheduled, that of all who take part; the cursor never
    /// goes back for it.
    /// </summary>
    private WorkVerdict CallRules(in EventKey key)
    {
        if (EventKey.Compare(key, rollback.Cursor) > 0)
        {
            rollback.Cursor = key;
        }

        long made = caller!.Made;
        caller.Process();
        progress.EventsProcessed++;
        return meter.TellCall(key, caller.Made > made, caller.Charged);
    }

    /// <summary>Not before the first instant that is kept: nothing could be read then.</summary>
    private bool MayWaitBefore(SimTime instant) => WaitsForLateEvents && instant > progress.HistoryEdge;

    private void RewindInstant(SimTime instant)
    {
        partDone = null;
        rewinder.RewindInstant(instant);
    }

    /// <summary>
    /// Moves the edge of the history along, event by event, so that one long advance takes no more memory than many short ones.
    /// </summary>
    private void ForgetUpTo(SimTime now)
    {
        if (progress.IsLongerThanHistory(now))
        {
            progress.ForgetBefore(now - progress.History);
            timelines.ForgetBefore(progress.HistoryEdge);
            broadPhase.Current.DropBefore(progress.HistoryEdge);
            caller?.DropBefore(progress.HistoryEdge);
        }
    }

    /// <summary>The history that is kept; where somebody else says what is forgotten, as far as it goes back now.</summary>
    private SimDuration Kept => progress.History < SimDuration.MaxValue ? progress.History : progress.SimulatedTo - progress.HistoryEdge;

    /// <summary>With what a failure ends the simulation: in the one way that callers know.</summary>
    private SimulationException Ending(Exception failure, SimTime reached) => failure switch
    {
        InstantException instant => instant.AsEnd(),
        TimelinesFullException full => new TimelinesFullException($"{full.Message}{failures.OfFullTimelines(Kept)}", full),
        _ => new SimulationException($"The simulation failed at or after {reached.ToShortString()}: {failure.Message}", failure),
    };

    /// <summary>Why an advance stops before the time that it was to reach.</summary>
    private enum Stop
    {
        None,
        OutOfEvents,
        Cancelled,
    }
}
