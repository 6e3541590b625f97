using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim;

/// <content>Telling an observer how much work each event is. The observer may stop an advance, in a session's world within an instant too, and changes nothing else.</content>
public sealed partial class Simulation
{
    private readonly int[] aloneAtWork = new int[1];

    /// <summary>Is told of every event that is processed; null, the default, costs nothing.</summary>
    internal IWorkObserver? Work { get; set; }

    /// <summary>The identity of the body in a place that a <see cref="IWorkObserver"/> was told.</summary>
    internal BodyId BodyIn(int slot) => bodies.Id(slot);

    /// <summary>
    /// What a body costs in an event that a contact solver solves, besides the sweeps. Measured with the next, by <c>LagSim.Bench --
    /// heapheals</c>.
    /// </summary>
    private const double WorkPerBody = 2;

    /// <summary>
    /// How many times what no contact solver solves counts where it is simulated again: it was measured at 2 to 40 times.
    /// </summary>
    private const double WorkAgain = 4;

    /// <summary>
    /// How much an event of so many bodies costs, in units of about a microsecond on a core of the 2020s. What contact solvers solve counts
    /// by their sweeps, and no more where it is done again. Else a lone bounce is 3, an impact in a crowd the square of who takes part, for
    /// all are held against all; and several times that where they are held against paths that stand already. docs/BUDGETS.md has how near
    /// that is.
    /// </summary>
    private double WorkOf(int bodies, bool isAgain) =>
        work.Done > 0 ? 2 + (WorkPerBody * bodies) + work.Done : (isAgain ? WorkAgain : 1) * (2 + ((double)bodies * bodies));

    /// <summary>Processes an event and tells the observer which bodies took part.</summary>
    /// <returns>What the observer says of it.</returns>
    private WorkVerdict ProcessTold(int slot, in EventKey key, IWorkObserver observer)
    {
        graph.Clear();
        work.Clear();
        Process(slot, key);
        bool isOfMany = graph.BodyCount > 0 && key.Kind is EventKind.Impact or EventKind.StepEnd;
        aloneAtWork[0] = slot;
        Span<int> who = isOfMany ? graph.Slots : aloneAtWork;
        bool isAgain = key.Time <= rollback.Horizon;
        return observer.OnWork(key, who, WorkOf(who.Length, isAgain), isAgain, this);
    }
}
