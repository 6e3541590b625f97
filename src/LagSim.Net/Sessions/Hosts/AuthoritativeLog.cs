using System;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>The host's log: each event is recorded once with its verdict, and settled once no joining client needs it.</summary>
internal sealed class AuthoritativeLog(SharedWorld world, Watermark watermark, EventJournal journal, SessionCounters counters, IClock clock)
{
    /// <summary>Raised for every recorded event, after it has taken effect here, so that it is sent to the clients.</summary>
    internal event Action<ExternalEvent>? Recorded;

    /// <summary>The log entries.</summary>
    internal LogLines Lines { get; } = new();

    /// <summary>The newest entry that no later one supersedes.</summary>
    internal uint LastUrgent { get; private set; }

    /// <summary>The time before which no client that joins later needs an event: both the watermark and the world have passed it.</summary>
    internal SimTime SettledTo { get; private set; } = SimTime.MinValue;

    /// <param name="external">The event.</param>
    /// <param name="verdict">The host's verdict.</param>
    /// <param name="hasEffect">Whether it is in this host's world.</param>
    internal void Record(in ExternalEvent external, Verdict verdict, bool hasEffect)
    {
        bool isAccepted = verdict.IsAcceptance();
        counters.EventsAccepted += isAccepted ? 1 : 0;
        counters.EventsRefused += isAccepted ? 0 : 1;
        counters.EventsMoved += verdict == Verdict.Moved ? 1 : 0;
        Lines.Add(external, verdict, SimTime.Min(watermark.Now, external.Time), clock.Now); // it was validated, or done, a little earlier
        LastUrgent = isAccepted && SendWindow.IsMadeUpFor(external) ? LastUrgent : Lines.Count;
        journal.Tell(Lines[Lines.Count], isAccepted && hasEffect);
        Recorded?.Invoke(external);
    }

    /// <summary>Advances what is settled.</summary>
    internal void Settle()
    {
        SimTime now = watermark.Now;
        SettledTo = SimTime.Max(SettledTo, world.Live is null ? now : SimTime.Min(now, world.Live.Simulation.SimulatedTo));
        Lines.Settle(SettledTo);
    }
}
