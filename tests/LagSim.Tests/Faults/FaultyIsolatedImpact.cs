using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Response;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Leaves every impact to the general way, or takes those for isolated in which more bodies meet at once.</summary>
internal sealed class FaultyIsolatedImpact(
    Scene scene, BodyTable bodies, TimelineStore timelines, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
    ContactGraph graph, FreeImpactResponse resolver, ImpactNotifier notifier, ImpactSegments segments, FaultyEngineParts faults)
    : IsolatedImpact(scene, bodies, timelines, scheduler, rollback, flights, graph, resolver, notifier, segments)
{
    private readonly EventScheduler scheduler = scheduler;

    internal override bool TryHandle(int slot, in EventKey key)
    {
        if (faults.TakesNoShortcut || faults.SwapsOperands)
        {
            return false;
        }

        if (faults.IgnoresTies)
        {
            int partner = scheduler.Contact(slot).Partner;
            Untie(slot);
            Untie(partner);
        }

        return base.TryHandle(slot, key);
    }

    private void Untie(int slot)
    {
        if (slot != PendingContact.NoPartner && scheduler.TryGet(slot, out EventKey key))
        {
            PendingContact contact = scheduler.Contact(slot);
            contact.IsTied = false;
            scheduler.Set(slot, key, contact);
        }
    }
}
