using System;
using LagSim.BroadPhase;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>
/// Finds each body's next event, and has it scheduled: the least of an external event, the end of a segment, a crossing of a sensor,
/// and a contact.
/// </summary>
/// <remarks>A body has one event pending at most; its next contact is never earlier than that.</remarks>
internal class EventPredictor(
    BodyTable bodies, TimelineStore timelines, EventLog log, EventScheduler scheduler, RollbackState rollback, FreeFlights flights,
    AdaptiveBroadPhase broadPhase, CollisionSearch search, SegmentLookup view)
{
    private readonly Paths paths = new(timelines);

    /// <summary>Finds crossings of sensors; null in a scene without.</summary>
    internal CrossingPredictor? Crossings { get; set; }

    /// <summary>Finds the body's next event and schedules it in place of any other.</summary>
    internal void Predict(int slot)
    {
        NextEvent next = new() { Partner = PendingContact.NoPartner };
        int external = log.Due(slot);
        if (external != EventLog.None)
        {
            next.Consider(log.Key(external));
        }

        int last = timelines.Last(slot);
        if (last != TimelineStore.None)
        {
            Crossings?.Consider(slot, last, ref next);
        }

        if (last != TimelineStore.None && timelines.Segment(last).IsPresent)
        {
            ConsiderPath(slot, last, ref next);
        }

        if (last != TimelineStore.None && timelines.Segment(last).Loss != LossReason.None)
        {
            ConsiderLoss(slot, last, ref next);
        }

        if (next.Any)
        {
            Schedule(slot, last, next);
        }
        else
        {
            scheduler.Remove(slot);
        }
    }

    /// <summary>
    /// Predicts a body's next event again, because the window for which the broad phase was asked has ended, or because the impact that
    /// is due was found with a segment on which its partner no longer is.
    /// </summary>
    internal virtual void Recheck(int slot) => Predict(slot);

    /// <summary>
    /// Whether the segment of the partner's path that the pending impact was found with is no longer what the partner is on then.
    /// </summary>
    internal bool IsStale(int slot, in EventKey key)
    {
        int partner = scheduler.Contact(slot).Partner;
        if (partner == PendingContact.NoPartner)
        {
            return false;
        }

        int piece = view.SegmentAt(partner, key);
        return piece == TimelineStore.None || timelines.Serial(piece) != scheduler.Contact(slot).PartnerSerial; // or forgotten meanwhile
    }

    private void ConsiderLoss(int slot, int last, ref NextEvent next)
    {
        BodyId id = bodies.Id(slot);
        SimTime time = timelines.Segment(last).End;
        next.Consider(new EventKey(time, paths.RoundAfter(last, time), EventKind.Lost, id, id, 0, (uint)timelines.Segment(last).Loss));
    }

    private void ConsiderPath(int slot, int last, ref NextEvent next)
    {
        BodyId id = bodies.Id(slot);
        SimTime end = timelines.Segment(last).End;
        if (end != SimTime.MaxValue)
        {
            next.Consider(new EventKey(end, paths.RoundAfter(last, end), EventKind.StepEnd, id, id, 0, 0));
        }

        SimTime from = SimTime.Max(timelines.Key(last).Time, rollback.Cursor.Time);
        Span<int> candidates = broadPhase.Current.Candidates(slot, bodies.Spec(slot).Radius, from, rollback.HealNumber, out SimTime until);
        if (until < end)
        {
            next.Consider(new EventKey(until, 0, EventKind.None, id, id, 0, 0));
        }

        if (flights.IsFree(slot) && !rollback.MayBeKnownBeyond(rollback.Cursor))
        {
            search.FindInFlight(slot, candidates, from, until, ref next);
        }
        else
        {
            search.FindAlong(slot, candidates, from, until, ref next);
        }
    }

    private void Schedule(int slot, int last, in NextEvent next)
    {
        int partner = next.Partner;
        bool isOfPast = partner != PendingContact.NoPartner && next.Piece != timelines.Last(partner);
        Set(slot, next, partner, isOfPast ? StandsWith(partner, next.Piece) : next.Piece, next.IsTied);
        if (partner == PendingContact.NoPartner || isOfPast)
        {
            return;
        }

        bool isPending = scheduler.TryGet(partner, out EventKey theirs);
        if (!isPending || EventKey.Compare(next.Key, theirs) < 0)
        {
            Set(partner, next, slot, last, next.IsTied || (isPending && theirs.Time == next.Key.Time));
        }
    }

    /// <summary>
    /// The partner's segment of a contact that was found with a segment that is not the partner's newest: that very segment.
    /// </summary>
    private protected virtual int StandsWith(int partner, int piece) => piece;

    private void Set(int slot, in NextEvent next, int partner, int piece, bool isTied)
    {
        scheduler.Set(slot, next.Key, new PendingContact
        {
            Partner = partner,
            Surface = next.Surface,
            PartnerSerial = partner == PendingContact.NoPartner ? 0 : timelines.Serial(piece),
            Residual = next.Residual,
            IsTied = isTied,
        });
    }
}
