using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Reports to an observer how much work each event is.</summary>
internal sealed class WorkMeter(BodyTable bodies, ContactGraph graph, EventWork work, RollbackState rollback)
{
    /// <summary>The cost of an event, and of each body that takes part, besides what the tests of paths and solvers cost.</summary>
    private const double WorkPerEvent = 1.5;

    private const double WorkPerBody = 1;

    /// <summary>
    /// The cost of a call of rules that do nothing in it: it was measured at 5, for a ball that bounces 29,000 times a second with and without
    /// rules that hear it. A call that stands was not made.
    /// </summary>
    private const double WorkPerCall = 5;

    /// <summary>Notified of every event that is processed; null, the default, costs nothing.</summary>
    internal IWorkObserver? Observer { get; set; }

    /// <summary>What was done for the event that was processed last.</summary>
    internal EventWork Work => work;

    /// <summary>An event is about to be processed.</summary>
    internal void Begin()
    {
        graph.Clear();
        work.Clear();
    }

    /// <summary>The event has been processed: reports to the observer which bodies took part.</summary>
    /// <returns>The observer's verdict.</returns>
    internal WorkVerdict Tell(int slot, in EventKey key)
    {
        bool isOfMany = graph.BodyCount > 0 && key.Kind is EventKind.Impact or EventKind.StepEnd;
        Span<int> alone = stackalloc int[1] { slot };
        Span<int> who = isOfMany ? graph.Slots : alone;
        double amount = WorkPerEvent + (WorkPerBody * who.Length) + work.Done;
        return Observer?.OnWork(key, who, amount, IsAgain(key), bodies) ?? WorkVerdict.GoOn;
    }

    /// <summary>Rules were called for an event, or that call stands: reports it to the observer.</summary>
    /// <param name="key">The event.</param>
    /// <param name="isMade">Whether the call was made.</param>
    /// <param name="charged">What it then said that it costs.</param>
    /// <returns>The observer's verdict.</returns>
    internal WorkVerdict TellCall(in EventKey key, bool isMade, double charged)
    {
        if (Observer is null)
        {
            return WorkVerdict.GoOn;
        }

        Span<int> who = stackalloc int[2];
        int count = 0;
        if (key.Kind is not (EventKind.Command or EventKind.Player or EventKind.Timer or EventKind.Start))
        {
            count = Add(who, 0, key.Body);
            count = key.Other == key.Body ? count : Add(who, count, key.Other);
        }

        return Observer.OnCall(key, who.Slice(0, count), isMade ? WorkPerCall + charged : 1, IsAgain(key), bodies);
    }

    private int Add(Span<int> who, int count, BodyId body)
    {
        int slot = bodies.SlotOf(body);
        if (slot < 0)
        {
            return count; // it has gone
        }

        who[count] = slot;
        return count + 1;
    }

    private bool IsAgain(in EventKey key) => rollback.IsActive && key.Time <= rollback.Horizon;
}
