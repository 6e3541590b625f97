using LagSim.Events;
using LagSim.Net.Clocks;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>Decides the host's verdict on a client's event; changes nothing.</summary>
internal sealed class EventValidator(
    PlayerPlaces places, SharedWorld world, SharedClock sharedTime, Watermark watermark, WorkBudget budget, SimDuration history)
{
    internal Verdict Validate(in ExternalEvent external)
    {
        SimTime now = sharedTime.Now;
        return world.Live is null || !world.MayEnter(external) ? Verdict.Invalid
            : !EventRights.Has(external, world.Scene!, world.Live.Simulation.PlayersOf(external.Body)) || !IsAdmittedTo(external) ? Verdict.NoRight
            : external.Time < watermark.Now || external.Time < world.Live.Simulation.Start ? Verdict.TooLate
            : external.Time > now + history ? Verdict.TooEarly
            : budget.IsShort(external) ? Verdict.NoRight
            : world.Limits.WhyNot(external, world.Live.Simulation, now, out _);
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
