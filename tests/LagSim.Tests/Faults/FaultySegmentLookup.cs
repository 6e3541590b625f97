using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>
/// A view that does not see what bodies did before a late event came: all of them, those that were rewound, or the partners of pending
/// contacts.
/// </summary>
internal sealed class FaultySegmentLookup(TimelineStore timelines, RollbackState rollback, FaultyEngineParts faults, bool isForPending)
    : SegmentLookup(timelines, rollback)
{
    private readonly TimelineStore timelines = timelines;

    /// <summary>How far the rollback has come of which it is a view.</summary>
    internal RollbackState Rollback { get; } = rollback;

    private protected override EventKey Now => faults.Has(HealingFault.ForgetsTheRound) ? Rollback.Cursor : base.Now;

    private protected override int PastSegmentFrom(int slot, int piece) =>
        faults.Has(HealingFault.ForgetsThePast) || IsOverlooked(timelines.Owner(piece)) ? piece : base.PastSegmentFrom(slot, piece);

    private protected override int PastSegmentAt(int slot, in EventKey key) =>
        IsOverlooked(slot) || (isForPending && faults.Has(HealingFault.GivesUpByBody)) ? timelines.Last(slot) : base.PastSegmentAt(slot, key);

    private bool IsOverlooked(int slot) => faults.Has(HealingFault.OverlooksBodiesAhead) && Rollback.HasTouched(slot);
}
