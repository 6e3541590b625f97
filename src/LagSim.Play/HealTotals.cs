namespace LagSim.Play;

/// <summary>What the heals of a world cost in all: how many there were, the events simulated again, and the bodies predicted again.</summary>
internal readonly record struct HealTotals(long Heals, long Events, long Bodies)
{
    /// <summary>Returns these and one more.</summary>
    internal HealTotals And(HealReport heal) => new(Heals + 1, Events + heal.Events, Bodies + heal.Bodies);
}
