namespace LagSim.Harness.Verification.Harm;

/// <summary>The kinds of attacks that overload other players' machines.</summary>
public enum HarmKind
{
    /// <summary>A ball is held a little above the floor, and another one moves fast in the gap.</summary>
    Gap,

    /// <summary>Many balls are spawned close together in a corner.</summary>
    Heap,

    /// <summary>A hand shakes a ball in a heap.</summary>
    ShakenHeap,

    /// <summary>A row of balls between two held ones, with fast outer ones.</summary>
    Row,

    /// <summary>Bodies are teleported into each other, or thrown about, as often as the host accepts.</summary>
    Storm,

    /// <summary>The scene's own bodies are set in motion at the highest speed, again and again.</summary>
    Scene,

    /// <summary>Acts of every kind, as often as the host accepts, in scenes in which single ones once ended the world.</summary>
    Acts,

    /// <summary>Balls are spawned at one point, and put there again.</summary>
    Crowd,

    /// <summary>Elastic balls that just fit between a floor and a ceiling are thrown up.</summary>
    Fit,

    /// <summary>Any acts, or balls thrown up where they just fit, in scenes with rules that hear of it and keep states.</summary>
    Rules,
}
