using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>One peer of a drawn session.</summary>
/// <param name="Link">Its link to the host; of the host itself without meaning.</param>
/// <param name="ClockPartsPerMillion">How much too fast its clock runs.</param>
/// <param name="ClockOffsetSeconds">How far it is ahead.</param>
/// <param name="AsksAtSeconds">When it asks to be let in, from the session's start on; null: before the start, which waits for it.</param>
/// <param name="LeavesAtSeconds">When it goes; null: not before the end.</param>
/// <param name="IsKilled">Whether it goes without a word: nobody hears of it any more, nor it of anybody.</param>
internal sealed record CheckPlayer(
    LinkProfile Link, double ClockPartsPerMillion, double ClockOffsetSeconds, double? AsksAtSeconds, double? LeavesAtSeconds, bool IsKilled)
{
    /// <summary>When its process stands still, from the session's start on, and for how long; null: never.</summary>
    public (double AtSeconds, double Seconds)? Stop { get; init; }

    /// <summary>
    /// Above how many bodies its world looks for contacts by the index; null: as everywhere, above 64. The world that never had a
    /// delay uses none, so that what the index overlooks is seen.
    /// </summary>
    public int? IndexAbove { get; init; }
}
