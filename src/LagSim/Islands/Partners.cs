using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Islands;

/// <summary>Finds the bodies on the other sides of contacts that members carry, by the segments on which they come to an event.</summary>
internal sealed class Partners(BodyTable bodies, TimelineStore timelines, SegmentLookup view, RewindRequests rewinds)
{
    private readonly CollisionFilters filters = new(timelines.Extras, default);
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// The near misses: bodies that were tested for the current event and take no part in it. Such a body does not carry a contact that
    /// another still carries with it.
    /// </summary>
    internal List<int> NearMisses { get; } = new();

    /// <summary>
    /// The other body of a carried contact, if it carries the contact too, or is held, and the two still collide. A body that is ahead of the key has to be rewound to
    /// it.
    /// </summary>
    internal bool TryFind(BodyId body, BodyId partnerId, in EventKey key, out int partner)
    {
        partner = bodies.SlotOf(partnerId);
        int piece = partner < 0 ? TimelineStore.None : view.SegmentBefore(partner, key);
        if (piece == TimelineStore.None)
        {
            return false;
        }

        if (piece != timelines.Last(partner))
        {
            rewinds.Add(partner, key);
        }

        bool holds = (paths.IsHeld(piece) || (paths.IsMember(piece) && timelines.Carried.With(piece, body) != TimelineStore.None))
            && filters.Meet(timelines.Last(bodies.SlotOf(body)), piece);
        if (!holds && !NearMisses.Contains(partner))
        {
            NearMisses.Add(partner);
        }

        return holds;
    }
}
