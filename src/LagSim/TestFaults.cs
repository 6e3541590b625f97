using LagSim.Timelines;

namespace LagSim;

/// <summary>What an engine does wrongly, or the long way, on purpose: negative controls, which only tests set.</summary>
internal sealed class TestFaults
{
    /// <summary>How it heals wrongly.</summary>
    internal HealingFault Healing { get; set; }

    /// <summary>Takes the operands of a contact the wrong way round.</summary>
    internal bool SwapsOperands { get; set; }

    /// <summary>Takes bodies that meet three at a time for two.</summary>
    internal bool IgnoresTies { get; set; }

    /// <summary>Gathers every impact, however plain, and looks at every pair: the same bits by the long way, to compare.</summary>
    internal bool TakesNoShortcut { get; set; }

    /// <summary>Takes no contact for one that lasts.</summary>
    internal bool IgnoresIslands { get; set; }

    /// <summary>Bounces as often as it closes.</summary>
    internal bool NeverCollapses { get; set; }

    /// <summary>Cuts timelines at their time instead of at their key, in a full rollback.</summary>
    internal bool CutsByTime { get; set; }

    /// <summary>Whether it heals wrongly in that way.</summary>
    internal bool Has(HealingFault wrong) => (Healing & wrong) != 0;
}
