using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Decides the host's verdict on a client's event; changes nothing else.</summary>
internal sealed class EventValidator(
    PlayerPlaces places, SharedWorld world, SharedClock sharedTime, Watermark watermark, WorkBudget budget, EventJournal journal,
    SimDuration history)
{
    /// <param name="external">The event; at another time if it is too late and happens later.</param>
    /// <param name="stamps">When its player's events happened.</param>
    internal Verdict Validate(ref ExternalEvent external, ClientStamps stamps)
    {
        SimTime now = sharedTime.Now;
        if (world.Live is null || !world.MayEnter(external))
        {
            return Verdict.Invalid;
        }

        if (!EventRights.Has(external, world.Scene!, world.Live.Simulation.PlayersOf(external.Body)) || !IsAdmittedTo(external))
        {
            return Verdict.NoRight;
        }

        SimTime earliest = SimTime.Max(watermark.Now, world.Live.Simulation.Start);
        bool isLate = external.Time < earliest;
        bool isBehind = external.Time <= stamps.LatestMoved; // stamped after one that has moved, and would come before it
        bool isMoved = (isLate || isBehind) && LateActions.MayMove(external, stamps, journal.Recent);
        if (isLate && !isMoved)
        {
            return Verdict.TooLate;
        }

        ExternalEvent happens = isMoved ? external.At(SimTime.Max(earliest, stamps.LatestMoved + SimDuration.OneTick)) : external;
        Verdict verdict = happens.Time > now + history ? Verdict.TooEarly
            : budget.IsShort(happens) ? Verdict.NoRight
            : world.Limits.WhyNot(happens, world.Live.Simulation, now, out _);
        if (verdict != Verdict.Accepted || !isMoved)
        {
            return verdict;
        }

        external = happens;
        return Verdict.Moved;
    }

    /// <summary>Whether it is a player's event, and the player's connect token, if it has one, grants it.</summary>
    private bool IsAdmittedTo(in ExternalEvent external)
    {
        if (external.Peer > SessionOptions.MaxClients)
        {
            return false; // a spectator
        }

        PlayerRights needed = external.Kind == EventKind.Spawn ? PlayerRights.Spawn : PlayerRights.Act;
        return places[external.Peer].Admission is not PlayerAdmission admission || (admission.Rights & needed) != 0;
    }
}
