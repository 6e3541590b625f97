using LagSim.Rollback;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Takes paths for reconverged where only places are the same, or only paths and not what bodies carry on them.</summary>
internal sealed class FaultyCutPaths(FaultyEngineParts faults) : CutPaths
{
    private protected override bool IsSamePath(TimelineStore timelines, int segment, in Piece piece) =>
        faults.Has(HealingFault.StopsWherePlacesMeet)
            ? timelines.Segment(segment).Position == piece.Segment.Position
            : base.IsSamePath(timelines, segment, piece);

    private protected override bool HasSameFilter(TimelineStore timelines, int segment, in Piece piece) =>
        faults.Has(HealingFault.IgnoresFilters) || base.HasSameFilter(timelines, segment, piece);

    private protected override bool CarriesTheSame(TimelineStore timelines, int segment, in Piece piece) =>
        faults.Has(HealingFault.StopsWherePlacesMeet | HealingFault.StopsWhereChordsMeet) || base.CarriesTheSame(timelines, segment, piece);
}
