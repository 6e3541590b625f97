using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Tells an observer how much work each event is.</summary>
internal sealed class WorkMeter(BodyTable bodies, ContactGraph graph, SolverWork work, RollbackState rollback)
{
    /// <summary>
    /// What a body costs in an event that a contact solver solves, besides the sweeps. Measured with the next, by <c>LagSim.Bench --
    /// heapheals</c>.
    /// </summary>
    private const double WorkPerBody = 2;

    /// <summary>
    /// How many times what no contact solver solves counts where it is simulated again: it was measured at 2 to 40 times.
    /// </summary>
    private const double WorkAgain = 4;

    /// <summary>Is told of every event that is processed; null, the default, costs nothing.</summary>
    internal IWorkObserver? Observer { get; set; }

    /// <summary>An event is about to be processed.</summary>
    internal void Begin()
    {
        graph.Clear();
        work.Clear();
    }

    /// <summary>The event has been processed: tells the observer which bodies took part.</summary>
    /// <returns>What the observer says of it.</returns>
    internal WorkVerdict Tell(int slot, in EventKey key)
    {
        bool isOfMany = graph.BodyCount > 0 && key.Kind is EventKind.Impact or EventKind.StepEnd;
        Span<int> alone = stackalloc int[1] { slot };
        Span<int> who = isOfMany ? graph.Slots : alone;
        bool isAgain = key.Time <= rollback.Horizon;
        return Observer?.OnWork(key, who, WorkOf(who.Length, isAgain), isAgain, bodies) ?? WorkVerdict.GoOn;
    }

    /// <summary>
    /// How much an event of so many bodies costs, in units of about a microsecond on a core of the 2020s. What contact solvers solve counts
    /// by their sweeps, and no more where it is done again. Else a lone bounce is 3, an impact in a crowd the square of who takes part, for
    /// all are held against all; and several times that where they are held against paths that stand already. docs/BUDGETS.md has how near
    /// that is.
    /// </summary>
    private double WorkOf(int bodies, bool isAgain) =>
        work.Done > 0 ? 2 + (WorkPerBody * bodies) + work.Done : (isAgain ? WorkAgain : 1) * (2 + ((double)bodies * bodies));
}
