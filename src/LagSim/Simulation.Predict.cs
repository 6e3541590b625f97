using System;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Prediction: the one pending event of a body.</content>
public sealed partial class Simulation
{
    /// <summary>Finds the body's next event, the least of step or law end, external event and contact, and queues it in place of any other.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="except">Another that is not met, whatever the paths say: only a fault put in on purpose names one.</param>
    private void Predict(int slot, int except = NoPartner)
    {
        NextEvent next = new() { Partner = NoPartner };
        int external = log.Due(slot);
        if (external != EventLog.None)
        {
            next.Consider(log.Key(external));
        }

        int last = timelines.Last(slot);
        if (last != TimelineStore.None && timelines.Segment(last).IsPresent)
        {
            BodyId id = bodies.Id(slot);
            SimTime end = timelines.Segment(last).End;
            if (end != SimTime.MaxValue)
            {
                next.Consider(new EventKey(end, paths.RoundAfter(timelines.Last(slot), end), EventKind.StepEnd, id, id, 0, 0));
            }

            SimTime from = SimTime.Max(timelines.Key(last).Time, rollback.Cursor.Time);
            Span<int> candidates = index.Candidates(slot, bodies.Spec(slot).Radius, from, HealAtHand, out SimTime until);
            if (until < end)
            {
                next.Consider(new EventKey(until, 0, EventKind.None, id, id, 0, 0));
            }

            if (flights.IsFree(slot) && !rollback.MayBeKnownBeyond(rollback.Cursor) && !TakesNoShortcut && !SwapsOperands)
            {
                search.FindInFlight(slot, candidates, from, until, except, ref next);
            }
            else
            {
                search.FindAlong(slot, candidates, from, until, except, ref next);
            }
        }

        if (!next.Any)
        {
            scheduler.Remove(slot);
            return;
        }

        Pend(slot, next, next.Partner, next.Piece);
        int partner = next.Partner;
        if (partner == NoPartner || next.Piece != timelines.Last(partner))
        {
            return;
        }

        bool isPending = scheduler.TryGet(partner, out EventKey theirs);
        if (!isPending || EventKey.Compare(next.Key, theirs) < 0)
        {
            next.IsTied |= isPending && theirs.Time == next.Key.Time;
            Pend(partner, next, slot, last);
        }
    }

    private void Pend(int slot, in NextEvent next, int partner, int piece)
    {
        scheduler.Set(slot, next.Key, new PendingContact
        {
            Partner = partner,
            Surface = next.Surface,
            PartnerSerial = partner == NoPartner ? 0 : timelines.Serial(faults.Has(HealingFault.GivesUpByBody) ? timelines.Last(partner) : piece),
            Residual = next.Residual,
            IsTied = next.IsTied,
        });
    }

}
