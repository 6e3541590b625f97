namespace LagSim.Harness.SceneFiles;

/// <summary>The state of <see cref="GoalsRules"/>, of a ball.</summary>
public struct GoalsBall
{
    /// <summary>What it has scored.</summary>
    public int Goals;

    /// <summary>1 from a power-up to its next goal, which counts twice.</summary>
    public int IsDouble;
}
