using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>The event loop.</content>
public sealed partial class Simulation
{
    private const int NoPartner = PendingContact.NoPartner;

    /// <summary>Lets everything happen up to and including <paramref name="time"/>.</summary>
    /// <remarks>Reading, and advancing in smaller or larger steps, changes no bit of what happens. Cost: per event, not per time.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="SimulatedTo"/>.</exception>
    /// <exception cref="SimulationException">A body left the range in which its state means something, or the timelines their memory.</exception>
    /// <exception cref="OperationCanceledException">The options' token asked for an end; what lies behind <see cref="SimulatedTo"/> stands.</exception>
    public void AdvanceTo(SimTime time)
    {
        AdvanceAsFarAs(time);
        if (Blocked is EndlessInstantException endless && endless.At <= time)
        {
            throw new SimulationException(endless.Message); // it can go on once an event comes that removes the cause
        }
    }

    /// <summary>
    /// Lets everything happen up to and including <paramref name="time"/>, or as much of it as so many events are, and stops between two instants; the world of a
    /// session (<see cref="Hosting.LiveWorld.WaitsForLateEvents"/>) stops within one too, if it takes too long.
    /// </summary>
    /// <param name="time">Up to when.</param>
    /// <param name="events">
    /// How many events may happen; what is left of them. The events of one instant all happen, so it may end below zero; at or below zero nothing happens.
    /// Looking again what a body meets next counts as an event.
    /// </param>
    /// <returns>
    /// Whether it got there; if not, <see cref="SimulatedTo"/> tells how far, and the next call goes on from there. A world that an instant without end blocks
    /// (<see cref="Hosting.LiveWorld.BlockedAt"/>) gets no further, whatever is left, until an event comes that lies no later.
    /// </returns>
    /// <remarks>Advancing in pieces changes no bit of what happens. Cost: per event, not per time.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="SimulatedTo"/>.</exception>
    /// <exception cref="SimulationException">A body left the range in which its state means something, or the timelines their memory.</exception>
    /// <exception cref="OperationCanceledException">The options' token asked for an end; what lies behind <see cref="SimulatedTo"/> stands.</exception>
    public bool TryAdvanceTo(SimTime time, ref long events)
    {
        ThrowIfFaulted();
        if (time < SimulatedTo)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"The world is simulated to {SimulatedTo.ToShortString()} already; it advances, and an event that lies"
                    + " before rolls it back.");
        }

        SimTime reached = SimulatedTo;
        bool isCancelled = false;
        bool isThere = true;
        WorkVerdict verdict = WorkVerdict.GoOn;
        SimTime until = SimTime.Min(time, BlockedAt - SimDuration.OneTick);
        try
        {
            while (scheduler.TryGetLeast(out int slot, out EventKey least) && least.Time <= until)
            {
                if (least.Time > reached)
                {
                    if (least.Time != partDone && HasMet(least.Time - SimDuration.OneTick, time))
                    {
                        reached = SimulatedTo;
                        continue;
                    }

                    isCancelled = cancellation.IsCancellationRequested;
                    isThere = events > 0;
                    if (isCancelled || !isThere)
                    {
                        break;
                    }

                    reached = least.Time;
                    partDone = SimTime.MinValue;
                    ForgetUpTo(reached);
                }
                else if (MayWaitBefore(reached) && (verdict == WorkVerdict.StopNow || cancellation.IsCancellationRequested))
                {
                    isCancelled = verdict != WorkVerdict.StopNow;
                    partDone = reached;
                    reached -= SimDuration.OneTick;
                    isThere = false;
                    break;
                }

                events--;
                rollback.Cursor = least;
                if (Work is IWorkObserver observer)
                {
                    WorkVerdict said = ProcessTold(slot, rollback.Cursor, observer);
                    verdict = said > verdict ? said : verdict;
                    events = verdict == WorkVerdict.GoOn ? events : Math.Min(events, 0);
                }
                else
                {
                    Process(slot, rollback.Cursor);
                }
            }
        }
        catch (EndlessInstantException endless)
        {
            if (!MayWaitBefore(endless.At))
            {
                fault = new SimulationException(endless.Message);
                throw fault;
            }

            BlockAt(endless);
            until = endless.At - SimDuration.OneTick;
        }
        catch (TimelinesFullException full)
        {
            fault = new TimelinesFullException($"{full.Message}{trajectories.Failures.OfFullTimelines(history)}", full);
            throw fault;
        }
        catch (SimulationException failure)
        {
            fault = failure;
            throw;
        }
        catch (Exception failure)
        {
            // Nothing that is known of: it too ends the simulation, in the one way that callers know.
            fault = new SimulationException($"The simulation failed at or after {reached.ToShortString()}: {failure.Message}", failure);
            throw fault;
        }

        SimulatedTo = isCancelled || !isThere ? reached : until;
        if (rollback.IsActive && SimulatedTo >= rollback.Horizon)
        {
            EndHeal();
        }

        ForgetUpTo(SimulatedTo);
        if (isCancelled)
        {
            throw new OperationCanceledException(cancellation);
        }

        FollowWithTwin();
        return isThere && until == time;
    }

    /// <summary>Moves the edge of the history along, event by event, so that one long advance takes no more memory than many short ones.</summary>
    private void ForgetUpTo(SimTime now)
    {
        // The span since the start may exceed the range of a long; as an unsigned difference it never does.
        if ((ulong)now.Ticks - (ulong)Start.Ticks > (ulong)history.Ticks)
        {
            HistoryEdge = SimTime.Max(HistoryEdge, now - history);
            timelines.ForgetBefore(HistoryEdge);
            index.DropBefore(HistoryEdge);
        }
    }

    private void Process(int slot, in EventKey key)
    {
        switch (key.Kind)
        {
            case EventKind.None:
                Predict(slot); // the window for which the index was asked has ended
                return;
            case EventKind.Impact:
                if (IsStale(slot, key))
                {
                    Predict(slot, faults.Has(HealingFault.GivesUpByBody) ? scheduler.Contact(slot).Partner : NoPartner);
                    return;
                }

                if (!TryHandleImpact(slot, key))
                {
                    return; // somebody was ahead of it; he has been taken back, and it is due again
                }

                ImpactsProcessed++;
                break;
            case EventKind.StepEnd:
                if (timelines.Segment(timelines.Last(slot)).Law == MotionLaw.Constrained)
                {
                    if (!TryHandleContactStep(slot, key))
                    {
                        return; // as above
                    }

                    break;
                }

                trajectories.OpenNext(slot, key);
                Predict(slot);
                break;
            default:
                if (!sleepers.TryFind(slot, key))
                {
                    TakeBackAhead(key);
                    return; // as above
                }

                int before = timelines.Last(slot);
                HandleExternal(slot, key);
                if (graph.BodyCount > 0 && timelines.Last(slot) != before && !(faults.Has(HealingFault.LeavesMates) && rollback.MayBeKnownBeyond(key)))
                {
                    sleepers.Wake(slot, key);
                    for (int i = 0; i < graph.BodyCount; i++)
                    {
                        Predict(graph.Slots[i]);
                    }
                }

                Predict(slot);
                break;
        }

        EventsProcessed++;
    }

    /// <summary>Whether the piece of the partner's path that the pending impact was found with is no longer what the partner is on then.</summary>
    private bool IsStale(int slot, in EventKey key)
    {
        int partner = scheduler.Contact(slot).Partner;
        if (partner == NoPartner)
        {
            return false;
        }

        int piece = faults.Has(HealingFault.GivesUpByBody) ? timelines.Last(partner) : view.PieceAt(partner, key);
        return piece == TimelineStore.None || timelines.Serial(piece) != scheduler.Contact(slot).PartnerSerial; // or forgotten meanwhile
    }
}
