namespace LagSim.Harness.Experiments.Drop;

/// <summary>The two halves of the thesis's drop test.</summary>
public enum DropCase
{
    /// <summary>Both balls start equal, fall, bounce and rest (Fig 2).</summary>
    SameStart,

    /// <summary>One side lifts its ball, and the other receives the event late (Fig 3).</summary>
    Teleport,
}
