namespace LagSim.Harness.Verification.Harm;

/// <summary>What a player tries, to have others' machines do more than they can.</summary>
public enum HarmKind
{
    /// <summary>A ball is held a little above the floor, and another moves fast in the gap.</summary>
    Gap,

    /// <summary>Many balls are spawned close together in a corner.</summary>
    Heap,

    /// <summary>A heap into which a hand shakes a ball.</summary>
    ShakenHeap,

    /// <summary>A row of balls between two that are held, the outer ones fast.</summary>
    Row,

    /// <summary>Bodies are teleported into each other, or thrown about, as often as the host takes it.</summary>
    Storm,

    /// <summary>What the scene has is set in motion as fast as may be, again and again.</summary>
    Scene,
}
