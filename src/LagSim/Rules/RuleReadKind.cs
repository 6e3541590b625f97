namespace LagSim.Rules;

/// <summary>What a <see cref="RuleRead"/> is of.</summary>
internal enum RuleReadKind
{
    /// <summary>A body's state, or that it is not there.</summary>
    Body,

    /// <summary>Which bodies are in a sphere. They are the reads that follow.</summary>
    Region,

    /// <summary>Whether a body is inside of a sensor.</summary>
    Sensor,

    /// <summary>Whether there is room for a body.</summary>
    Room,
}
