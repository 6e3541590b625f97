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
    internal BodyId BodyIn(int slot) => bodies[slot].Id;

    /// <summary>
    /// How much an event of so many bodies costs, in units of about a microsecond on a core of the 2020s: a lone bounce 2 to 4, an impact in a crowd as the square of who
    /// takes part, for all are held against all. With friction that is right to a factor of two, without it is up to four times too much.
    /// </summary>
    private static double WorkOf(int bodies) => 2 + ((double)bodies * bodies);

    /// <summary>Processes an event and tells the observer which bodies took part.</summary>
    /// <returns>What the observer says of it.</returns>
    private WorkVerdict ProcessTold(int slot, in EventKey key, IWorkObserver observer)
    {
        partyCount = 0;
        Process(slot, key);
        bool isOfMany = partyCount > 0 && key.Kind is EventKind.Impact or EventKind.StepEnd;
        aloneAtWork[0] = slot;
        Span<int> who = isOfMany ? parties.AsSpan(0, partyCount) : aloneAtWork;
        return observer.OnWork(key, who, WorkOf(who.Length), key.Time <= front, this);
    }
}
