
namespace LagSim.BroadPhase;

/// <summary>Cells along one axis, both ends included.</summary>
internal readonly struct CellRange
{
    internal CellRange(long from, long to)
    {
        From = from;
        To = to;
    }

    internal long From { get; }

    internal long To { get; }

    internal double Count => To - From + 1.0;
}
