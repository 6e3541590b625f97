using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Reports to an observer how much work each event is.</summary>
internal sealed class WorkMeter(BodyTable bodies, ContactGraph graph, SolverWork work, RollbackState rollback)
{
    /// <summary>
    /// The cost of a body in an event that a contact solver solves, besides the sweeps. Measured together with the next constant, by
    /// <c>LagSim.Bench -- heapheals</c>.
    /// </summary>
    private const double WorkPerBody = 2;

    /// <summary>
    /// How many times what no contact solver solves counts where it is simulated again: it was measured at 2 to 40 times.
    /// </summary>
    private const double WorkAgain = 4;

    /// <summary>
    /// The cost of a call of rules that do nothing in it: it was measured at 5, for a ball that bounces 29,000 times a second with and without
    /// rules that hear it. A call that stands was not made.
    /// </summary>
    private const double WorkPerCall = 5;

    /// <summary>Notified of every event that is processed; null, the default, costs nothing.</summary>
    internal IWorkObserver? Observer { get; set; }

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
        bool isAgain = IsAgain(key);
        return Observer?.OnWork(key, who, WorkOf(who.Length, isAgain), isAgain, bodies) ?? WorkVerdict.GoOn;
    }

    /// <summary>Rules were called for an event, or that call stands: reports it to the observer.</summary>
    /// <returns>The observer's verdict.</returns>
    internal WorkVerdict TellCall(in EventKey key, bool isMade)
    {
        if (Observer is null)
        {
            return WorkVerdict.GoOn;
        }

        Span<int> who = stackalloc int[2];
        int count = 0;
        if (key.Kind is not (EventKind.Command or EventKind.Timer or EventKind.Start))
        {
            count = Add(who, 0, key.Body);
            count = key.Other == key.Body ? count : Add(who, count, key.Other);
        }

        return Observer.OnCall(key, who.Slice(0, count), isMade ? WorkPerCall : 1, IsAgain(key), bodies);
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

    /// <summary>
    /// The cost of an event by its number of bodies, in units of about a microsecond on a core of the 2020s. Events of contact solvers
    /// count by their sweeps, and no more where they are re-simulated. Otherwise a lone bounce is 3, and an impact in a crowd is the square
    /// of the bodies that take part, because all are tested against all. It is several times that where they are tested against existing
    /// paths. docs/BUDGETS.md says how accurate that is.
    /// </summary>
    private double WorkOf(int bodies, bool isAgain) =>
        work.Done > 0 ? 2 + (WorkPerBody * bodies) + work.Done : (isAgain ? WorkAgain : 1) * (2 + ((double)bodies * bodies));
}
