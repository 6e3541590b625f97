using LagSim.Collisions;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>A predictor that gives up a pending contact once its partner has changed, as if the partner would find it anew.</summary>
internal sealed class FaultyEventPredictor(
    BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
    FaultyBroadPhase broadPhase, CollisionSearch search, FaultySegmentLookup view, FaultyEngineParts faults)
    : EventPredictor(bodies, timelines, log, scheduler, rollback, flights, broadPhase, search, view)
{
    private readonly TimelineStore timelines = timelines;
    private readonly EventScheduler scheduler = scheduler;
    private readonly FaultyBroadPhase broadPhase = broadPhase;

    internal override void Recheck(int slot)
    {
        broadPhase.LeftOut = faults.Has(HealingFault.GivesUpByBody) ? scheduler.Contact(slot).Partner : PendingContact.NoPartner;
        base.Recheck(slot);
        broadPhase.LeftOut = PendingContact.NoPartner;
    }

    private protected override int StandsWith(int partner, int piece) =>
        faults.Has(HealingFault.GivesUpByBody) ? timelines.Last(partner) : base.StandsWith(partner, piece);
}
